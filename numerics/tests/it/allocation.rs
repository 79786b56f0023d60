//! What may allocate and what may not.
#![allow(unsafe_code, reason = "a global allocator cannot be written without it")]

use std::alloc::{GlobalAlloc, Layout, System as SystemAllocator};
use std::cell::Cell;

use partita_numerics::{Connectivity, Factor, Method, Scatter};

use crate::grid::{self, Flow, System};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, counting for each thread.
struct Counting;

// SAFETY: every call is passed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { SystemAllocator.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { SystemAllocator.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { SystemAllocator.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The allocations of `work` on this thread.
fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.with(Cell::get);
    work();
    ALLOCATIONS.with(Cell::get) - before
}

fn refactor_and_solve(method: Method, system: &System) -> (usize, usize) {
    let mut factor = Factor::new(method, &system.pattern).unwrap();
    // The first call sizes the buffers of LU, and the packing buffer of this thread's matrix kernels.
    factor.refactor(&system.values).unwrap();
    let mut rhs = vec![1.0; system.pattern.size()];
    let refactor = allocations(|| factor.refactor(&system.values).unwrap());
    (refactor, allocations(|| factor.solve(&mut rhs)))
}

#[test]
fn counter_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(vec![0_u8; 100]))), 1);
    assert_eq!(allocations(|| ()), 0);
}

#[test]
fn cholesky_refactors_and_solves_without_allocating() {
    for n in [1, 5, 40] {
        let system = grid::elasticity(n, 0.3, true);
        assert_eq!(refactor_and_solve(Method::Llt, &system), (0, 0));
        assert_eq!(refactor_and_solve(Method::Ldlt, &system), (0, 0));
    }
}

#[test]
fn lu_solves_without_allocating() {
    let flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };
    let (_, solve) = refactor_and_solve(Method::Lu, &grid::flow(15, flow, true));
    assert_eq!(solve, 0);
}

#[test]
fn node_block_lu_refactors_and_solves_without_allocating() {
    let flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };
    // The last one is large enough for the kernels of faer.
    for n in [1, 5, 15, 90] {
        let system = grid::flow(n, flow, true);
        assert_eq!(refactor_and_solve(Method::NodeBlockLu, &system), (0, 0), "{n} squares a side");
    }
}

#[test]
fn several_threads_allocate_nothing_but_their_start() {
    let flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };
    let system = grid::flow(62, flow, true);
    let mut factor = Factor::with_threads(Method::NodeBlockLu, &system.pattern, 2).unwrap();
    factor.refactor(&system.values).unwrap();
    let mut rhs = vec![1.0; system.pattern.size()];
    let start = allocations(|| {
        std::thread::scope(|scope| drop(std::thread::Builder::new().spawn_scoped(scope, || ()).unwrap()));
    });
    // One thread is started for the way down the tree, and one for the way up.
    assert!(start > 0);
    assert_eq!(allocations(|| factor.refactor(&system.values).unwrap()), 2 * start);
    assert_eq!(allocations(|| factor.solve(&mut rhs)), 2 * start);
}

#[test]
fn assembly_does_not_allocate() {
    let system = grid::elasticity(5, 0.3, true);
    let triangles = Connectivity::from_nodes(3, &grid::triangles(5), 2);
    let scatter = Scatter::new(&system.pattern, &system.dofs, &triangles);
    let (mut values, local) = (vec![0.0; system.pattern.nonzeros()], [1.0; 36]);
    let (x, mut y) = (vec![1.0; system.pattern.size()], vec![0.0; system.pattern.size()]);
    let count = allocations(|| {
        for triangle in 0..triangles.len() {
            scatter.add_matrix(triangle, &local, &mut values);
        }
        system.pattern.multiply(&values, &x, &mut y);
    });
    assert_eq!(count, 0);
}
