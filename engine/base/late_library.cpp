#include "engine/base/late_library.h"

#include <filesystem>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree {

namespace {

// Where this very code was loaded from: the program, or the Python module.
std::filesystem::path own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&late_symbol), &info) == 0 || info.dli_fname == nullptr) return {};
  const std::filesystem::path file = info.dli_fname;
  // A program is known by what it was called as.
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return file.has_parent_path() && std::filesystem::exists(file) && file.extension() == ".so" ? file.parent_path()
                                                                                              : program.parent_path();
}

void* open(const std::filesystem::path& library) {
  return dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
}

// Where the library may stand, from the program or module: installed in bin or lib/python3/dist-packages; built in bin, python,
// or tests/ROOM.
std::vector<std::filesystem::path> places(const std::string& library) {
  const std::filesystem::path folder = own_folder();
  std::vector<std::filesystem::path> all;
  for (const char* installed : {"..", "../../.."}) all.push_back(folder / installed / SCREE_PRIVATE_LIBDIR / library);
  for (const char* built : {"..", "../.."}) all.push_back(folder / built / "lib" / library);
  return all;
}

void* load(const std::string& library) {
  for (const std::filesystem::path& file : places(library)) {
    if (!std::filesystem::exists(file)) continue;
    if (void* const found = open(file)) return found;
    throw RunError(fmt::format("{} cannot be loaded: {}", file.string(), dlerror()));
  }
  // Where the search path of a project that found Scree says.
  if (void* const found = open(library)) return found;
  throw RunError(fmt::format("{} cannot be loaded: {}. It is installed with Scree", library, dlerror()));
}

}  // namespace

void* late_symbol(const std::string& library, const std::string& name) {
  void* const found = dlsym(load(library), name.c_str());
  if (found == nullptr) throw RunError(fmt::format("{} has no {}: it is of another version of Scree", library, name));
  return found;
}

}  // namespace scree
