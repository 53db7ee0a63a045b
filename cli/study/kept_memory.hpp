#pragma once
// The C library's allocator told to keep what is freed.
//
// Why        a diagnosis allocates and frees its runs and slopes, some 50 MB each, a hundred times;
//            given back to the system and asked for anew, every page of them faults each time
//            (a tenth of the processor time).
// Thread     once, before threads are started. Other C libraries than glibc: does nothing.

namespace levitas::cli {

void KeepFreedMemory() noexcept;

}  // namespace levitas::cli
