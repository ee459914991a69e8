// How long a thread that has done its part of a loop waits for the others with its processor kept busy.
#pragma once

namespace scree {

// To be called before loops that use all processors: from then on for moments only. libgomp spins 300,000 times (some 3 ms)
// otherwise, and a thread that spins keeps the one it waits for from working where another program takes a processor: a contact
// search of two threads then takes up to ten times as long as one thread alone. It spins 100 times if it has more threads than
// processors (GOMP_SPINCOUNT in its manual), so two that sleep for good are made, once in a process, one of which it has not
// counted. Nothing is done if the environment says how to wait (GOMP_SPINCOUNT, OMP_WAIT_POLICY), or where the calling thread
// uses fewer threads than there are processors.
void wait_briefly();

}  // namespace scree
