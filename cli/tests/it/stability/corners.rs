//! The hardest corners of the shipped maps, few steps each.
