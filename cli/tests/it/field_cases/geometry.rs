//! Structures that only look whole, held or in place.
