#include "thermal/hypre_library.h"

#include <cstdlib>
#include <string>

#include <dlfcn.h>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::thermal::hypre {

namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw RunError(
      fmt::format("hypre could not be loaded: {}. Install {}, or take heat.solver: cholesky", reason, SCREE_HYPRE_LIBRARY));
}

// One process that talks to nobody: Open MPI then starts in hundredths of a second instead of half a second, without helpers
// and without a look for networks. What the user has set stays.
void keep_to_one_process() {
  constexpr int overwrite = 0;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", overwrite);
  setenv("OMPI_MCA_pml", "ob1", overwrite);
  setenv("OMPI_MCA_btl", "self", overwrite);
  // It would make folders for its processes to find each other, and stop the program where another one that ends takes away the
  // folder above them just then, as runs of a study do.
  setenv("OMPI_MCA_orte_create_session_dirs", "0", overwrite);
  // It looks for graphics cards on X displays, too, and a display that closes meanwhile ends the program.
  setenv("HWLOC_COMPONENTS", "-gl", overwrite);
}

// Open MPI loses some memory while it starts, which no check of our leaks should count.
int init_mpi() {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler its_own;
#endif
  return SCREE_HYPRE(MPI_Init)(nullptr, nullptr);
}

void start_mpi() {
  int started = 0;
  SCREE_HYPRE(MPI_Initialized)(&started);
  if (started != 0) return;
  keep_to_one_process();
  if (init_mpi() != MPI_SUCCESS) throw RunError("MPI, which hypre needs, could not be started");
  std::atexit([] { SCREE_HYPRE(MPI_Finalize)(); });
}

// Loaded once; what was loaded stays.
void* library() {
  static void* const handle = dlopen(SCREE_HYPRE_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  static const std::string reason = handle == nullptr ? dlerror() : "";
  if (handle == nullptr) refuse(reason);
  return handle;
}

}  // namespace

void* find(const char* name) {
  void* const symbol = dlsym(library(), name);  // of what it is linked with, too
  if (symbol == nullptr) refuse(dlerror());
  return symbol;
}

void start() {
  static const bool started = [] {
    start_mpi();
    SCREE_HYPRE(HYPRE_Init)();
    return true;
  }();
  SCREE_EXPECT(started);
}

// Alone: other processes of somebody else's MPI have matrices of their own. The header's constant would need MPI to be linked.
MPI_Comm communicator() {
  return static_cast<MPI_Comm>(find("ompi_mpi_comm_self"));
}

std::string take_errors() {
  HYPRE_Int flags = SCREE_HYPRE(HYPRE_GetError)();
  if (flags == 0) return {};
  SCREE_HYPRE(HYPRE_ClearAllErrors)();
  flags &= ~HYPRE_ERROR_CONV;
  if (flags == 0) return {};
  char text[1024] = {};
  SCREE_HYPRE(HYPRE_DescribeError)(flags, text);
  return text;
}

}  // namespace scree::thermal::hypre
