// hypre's calls, found in its library when they are first needed: it brings MPI with it, which runs without it do without.
#pragma once

#include <string>

#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>

namespace scree::thermal::hypre {

// Starts MPI for this one process if nobody has, and hypre; once. Throws RunError if the library is not there.
void start();

// What it calls this process [of MPI].
MPI_Comm communicator();

// Throws RunError for a name that is not there.
void* find(const char* name);

// What hypre said since the last call, and forgets it; empty for nothing. That an iteration did not converge is no error here.
std::string take_errors();

template <class Function>
Function* found(const char* name) {
  return reinterpret_cast<Function*>(find(name));
}

// The function itself, of the type that the header declares.
#define SCREE_HYPRE(function) (::scree::thermal::hypre::found<decltype(function)>(#function))

}  // namespace scree::thermal::hypre
