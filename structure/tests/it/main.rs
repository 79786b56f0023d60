//! Tests of the structure through its public interface.

#![allow(clippy::float_cmp, reason = "equality to the bit is what many of these tests ask for")]

mod clamped_beam;
mod common;
mod crushed;
mod energy;
mod first_mode;
mod interface;
mod invariance;
mod lagrange;
mod newton_loop;
mod patch_test;
mod refusals;
mod restart;
mod rigid;
mod round_off;
mod supports;
mod tangent;
mod turek_hron;
mod vibration;
