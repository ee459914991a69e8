// The heap of a whole process in huge pages, for programs that run once and end.
#pragma once

namespace scree {

// To be called first of all, before main() where other static objects take memory. Where the system has to find a page of 4 kB
// for every few hundred numbers that are written first, a small run spends a third of its time on that, half of it on a virtual
// machine whose host maps them in software, and a large one more. Takes 64 MB of addresses, and of memory what is used of them,
// in pages of 2 MB where the system has these; all threads share it. So does what the heap grows by. Programs that link this
// have a malloc() and free() of their own by which arrays worth huge pages (huge_pages.h) lie outside of it in such pages,
// whoever makes them, and some of those that are freed are kept for others (kept_blocks.h).
void keep_heap_in_huge_pages();

}  // namespace scree
