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
  if (dladdr(reinterpret_cast<void*>(&late_symbol), &info) != 0) {
    const std::filesystem::path file = info.dli_fname;
    if (file.extension() == ".so") return file.parent_path();
  }
  // A program is known there only by what it was called as.
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
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
