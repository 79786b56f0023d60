//! Where a step starts: extrapolation of the interface displacement from accepted steps.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::vector::add_scaled;

/// The order of the extrapolation in time.
///
/// A predictor of order q is exact for polynomials of degree q in time, for steps of any size. While
/// fewer than q + 1 states are known, it takes the order they allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Predictor {
    /// The last displacement.
    #[default]
    Constant,
    /// The line through the last two.
    Linear,
    /// The parabola through the last three.
    Quadratic,
    /// The cubic through the last four.
    Cubic,
}

impl Predictor {
    /// Degree of the polynomials that are reproduced exactly.
    #[must_use]
    pub fn order(self) -> usize {
        match self {
            Self::Constant => 0,
            Self::Linear => 1,
            Self::Quadratic => 2,
            Self::Cubic => 3,
        }
    }

    /// Fills `x` with the prediction at `time` \[s\] from the states in `past`.
    ///
    /// Lagrange's form: `x(t) = sum_j x_j prod_{m != j} (t - t_m) / (t_j - t_m)`.
    ///
    /// # Panics
    /// When `past` is empty, or `x` has another length than its states.
    pub fn predict(self, past: &Past, time: f64, x: &mut [f64]) {
        assert!(!past.states.is_empty(), "a prediction needs at least one known state");
        let known = past.states.len().min(self.order() + 1);
        x.fill(0.0);
        for j in 0..known {
            let from = &past.states[j];
            let weight: f64 = (0..known)
                .filter(|&m| m != j)
                .map(|m| (time - past.states[m].time) / (from.time - past.states[m].time))
                .product();
            add_scaled(weight, &from.displacement, x);
        }
    }
}

/// The interface displacement at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Known {
    /// Time \[s\].
    pub time: f64,
    /// Interface displacement \[m\].
    pub displacement: Vec<f64>,
}

/// The latest accepted interface displacements, newest first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Past {
    states: VecDeque<Known>,
}

impl Past {
    /// Most states any predictor needs.
    const CAPACITY: usize = 4;

    /// The past of a run that starts at `time` \[s\] from `displacement`.
    #[must_use]
    pub fn new(time: f64, displacement: Vec<f64>) -> Self {
        Self { states: VecDeque::from([Known { time, displacement }]) }
    }

    /// Adds the displacement accepted at `time`; the oldest one beyond the fourth is forgotten.
    ///
    /// # Panics
    /// When `time` does not lie after the states known, or the length changes.
    pub fn push(&mut self, time: f64, displacement: &[f64]) {
        let newest = &self.states[0];
        assert!(time > newest.time, "time must go forward: {time} s after {} s", newest.time);
        assert_eq!(displacement.len(), newest.displacement.len(), "the interface changed its size");
        let mut state = if self.states.len() < Self::CAPACITY {
            Known { time, displacement: vec![0.0; displacement.len()] }
        } else {
            self.states.pop_back().expect("the past holds states")
        };
        state.time = time;
        state.displacement.copy_from_slice(displacement);
        self.states.push_front(state);
    }

    /// The latest accepted displacement.
    #[must_use]
    pub fn newest(&self) -> &Known {
        &self.states[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Predictor; 4] =
        [Predictor::Constant, Predictor::Linear, Predictor::Quadratic, Predictor::Cubic];

    fn polynomial(degree: usize, time: f64) -> f64 {
        (0..=degree).map(|power| (power as f64 + 1.5) * time.powi(i32::try_from(power).unwrap())).sum()
    }

    fn past_of(degree: usize, times: &[f64]) -> Past {
        let mut past = Past::new(times[0], vec![polynomial(degree, times[0])]);
        for &time in &times[1..] {
            past.push(time, &[polynomial(degree, time)]);
        }
        past
    }

    #[test]
    fn order_q_reproduces_polynomials_of_degree_q_and_no_higher_one() {
        let times = [0.0, 0.1, 0.25, 0.3, 0.5];
        for predictor in ALL {
            for degree in 0..=4 {
                let mut x = [f64::NAN];
                predictor.predict(&past_of(degree, &times), 0.65, &mut x);
                let error = (x[0] - polynomial(degree, 0.65)).abs();
                if degree <= predictor.order() {
                    assert!(error < 1e-12, "{predictor:?} misses degree {degree} by {error}");
                } else {
                    assert!(error > 1e-3, "{predictor:?} cannot be exact for degree {degree}");
                }
            }
        }
    }

    #[test]
    fn start_up_takes_the_order_the_known_states_allow() {
        for known in 1..=4 {
            let times: Vec<f64> = (0..known).map(|n| n as f64 * 0.1).collect();
            for predictor in ALL {
                let degree = predictor.order().min(known - 1);
                let mut x = [f64::NAN];
                predictor.predict(&past_of(degree, &times), 0.5, &mut x);
                assert!((x[0] - polynomial(degree, 0.5)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn constant_predictor_returns_the_last_displacement_bit_for_bit() {
        let mut past = Past::new(0.0, vec![0.0, 0.0]);
        past.push(0.1, &[0.1 + 0.2, -1e-300]);
        let mut x = [f64::NAN; 2];
        Predictor::Constant.predict(&past, 0.2, &mut x);
        assert_eq!(x.map(f64::to_bits), [0.1 + 0.2, -1e-300_f64].map(f64::to_bits));
    }
}
