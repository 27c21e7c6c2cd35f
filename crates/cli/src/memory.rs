//! Where does the program's memory come from? From the system; if there is none left, the program ends with a message.

use std::alloc::{GlobalAlloc, Layout, System};

use crate::stop::end_without_memory;

/// Memory of the system; if there is none left, the program ends with a message instead of a signal.
struct Memory;

#[global_allocator]
static MEMORY: Memory = Memory;

/// The system's memory, never null.
fn given(memory: *mut u8) -> *mut u8 {
    if memory.is_null() {
        end_without_memory()
    }
    memory
}

// SAFETY: every request goes to the system's allocator unchanged, and its answer is returned unchanged. This is the
// only unsafe code of the program.
unsafe impl GlobalAlloc for Memory {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        given(unsafe { System.realloc(memory, layout, size) })
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}
