//! Where does the program's memory come from? From the system; where there is none left the program ends with words.

use std::alloc::{GlobalAlloc, Layout, System};

use crate::stop::end_without_memory;

/// Memory of the system; where there is none left the program ends with words, in place of a signal.
struct Memory;

#[global_allocator]
static MEMORY: Memory = Memory;

/// What the system gave, which is something.
fn given(memory: *mut u8) -> *mut u8 {
    if memory.is_null() {
        end_without_memory()
    }
    memory
}

// SAFETY: every request goes to the system's allocator as it came, and its answer goes back as it is. This is
// the only unsafe code of the program.
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
