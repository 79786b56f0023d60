//! What stops a run, or lets it pass, at the limits of the arithmetic.
