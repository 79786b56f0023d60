//! One formula for one number or for several side by side.
//!
//! A kernel that is written for any [`Real`] works on `f64` and on the lanes of a vector register alike, so that several
//! elements are computed at once by the formula one reads. [`on_lanes`] chooses the widest registers when the program
//! runs.
//!
//! Each lane is rounded like an `f64`: there is no fused multiplication and addition. So the numbers do not depend on
//! the width, nor on the machine.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use pulp::{Arch, Simd, WithSimd, bytemuck};

/// The widest registers hold this many numbers.
pub const MAX_LANES: usize = 8;

/// A real number, or several of them, one a lane.
pub trait Real:
    Copy
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Div<f64, Output = Self>
    + Neg<Output = Self>
{
    /// How many numbers it holds.
    const LANES: usize;

    /// `value` in as many lanes as `self` has.
    #[must_use]
    fn like(self, value: f64) -> Self;

    /// `number(lane)` in each of as many lanes as `self` has.
    #[must_use]
    fn gather(self, number: impl Fn(usize) -> f64) -> Self;

    /// The numbers, one a lane.
    fn lanes(&self) -> &[f64];

    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The larger one; `self`, where `other` is not a number.
    #[must_use]
    fn max(self, other: Self) -> Self;
}

impl Real for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn gather(self, number: impl Fn(usize) -> f64) -> Self {
        number(0)
    }

    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        std::slice::from_ref(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }
}

/// The sum of `term(k)` for k = 0, 1, ... N - 1, in this order.
///
/// ```
/// assert_eq!(partita_numerics::lanes::sum::<3, f64>(|k| k as f64), 3.0);
/// ```
///
/// # Panics
///
/// If N is zero.
#[inline(always)]
#[must_use]
pub fn sum<const N: usize, T: Real>(term: impl Fn(usize) -> T) -> T {
    let mut sum = term(0);
    for k in 1..N {
        sum += term(k);
    }
    sum
}

/// `[entry(0), entry(1), ... entry(N - 1)]`, like [`std::array::from_fn`], but part of the code that calls it.
///
/// ```
/// assert_eq!(partita_numerics::lanes::array::<3, _>(|k| 2 * k), [0, 2, 4]);
/// ```
#[inline(always)]
#[must_use]
pub fn array<const N: usize, T: Copy>(entry: impl Fn(usize) -> T) -> [T; N] {
    let mut array = [entry(0); N];
    for k in 1..N {
        array[k] = entry(k);
    }
    array
}

/// Work that is written once for any number of lanes.
///
/// Mark [`run`](Self::run) and all it calls with `#[inline(always)]`: what is called from outside of an instruction set
/// falls back to scalars.
pub trait Kernel {
    /// What it gives.
    type Output;

    /// Works on as many lanes as `zero` has.
    fn run<T: Real>(self, zero: T) -> Self::Output;
}

/// Runs a kernel on the widest registers of this machine.
///
/// ```
/// use partita_numerics::lanes::{Kernel, Real, on_lanes};
///
/// struct Roots([f64; 8]);
///
/// impl Kernel for Roots {
///     type Output = Vec<f64>;
///
///     #[inline(always)]
///     fn run<T: Real>(self, zero: T) -> Vec<f64> {
///         let batches = (0..8).step_by(T::LANES);
///         batches.flat_map(|start| zero.gather(|lane| self.0[start + lane]).sqrt().lanes().to_vec()).collect()
///     }
/// }
///
/// let squares = [0.0, 1.0, 4.0, 9.0, 16.0, 25.0, 36.0, 49.0];
/// assert_eq!(on_lanes(Roots(squares)), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
/// ```
#[inline]
pub fn on_lanes<K: Kernel>(kernel: K) -> K::Output {
    Arch::new().dispatch(OnLanes(kernel))
}

struct OnLanes<K>(K);

impl<K: Kernel> WithSimd for OnLanes<K> {
    type Output = K::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        const { assert!(S::F64_LANES <= MAX_LANES, "registers are wider than MAX_LANES says") };
        self.0.run(Lanes { simd, numbers: simd.splat_f64s(0.0) })
    }
}

/// A vector register of numbers.
#[derive(Clone, Copy)]
struct Lanes<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

impl<S: Simd> Real for Lanes<S> {
    const LANES: usize = S::F64_LANES;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self { numbers: self.simd.splat_f64s(value), ..self }
    }

    #[inline(always)]
    fn gather(self, number: impl Fn(usize) -> f64) -> Self {
        let mut numbers = [0.0; MAX_LANES];
        for lane in 0..S::F64_LANES {
            numbers[lane] = number(lane);
        }
        let (vectors, _) = S::as_simd_f64s(&numbers);
        Self { numbers: vectors[0], ..self }
    }

    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        bytemuck::cast_slice(std::slice::from_ref(&self.numbers))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { numbers: self.simd.sqrt_f64s(self.numbers), ..self }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self { numbers: self.simd.abs_f64s(self.numbers), ..self }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // x86 gives its second operand where one is not a number.
        Self { numbers: self.simd.max_f64s(other.numbers, self.numbers), ..self }
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { numbers: self.simd.add_f64s(self.numbers, other.numbers), ..self }
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { numbers: self.simd.sub_f64s(self.numbers, other.numbers), ..self }
    }
}

impl<S: Simd> SubAssign for Lanes<S> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { numbers: self.simd.mul_f64s(self.numbers, other.numbers), ..self }
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * self.like(factor)
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { numbers: self.simd.div_f64s(self.numbers, other.numbers), ..self }
    }
}

impl<S: Simd> Div<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: f64) -> Self {
        self / self.like(divisor)
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { numbers: self.simd.neg_f64s(self.numbers), ..self }
    }
}
