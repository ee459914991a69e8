// Parts of Scree that are libraries of their own, loaded by the first call into them: those that stand on libraries which take
// longer to load than a small run takes.
#pragma once

#include <string>

namespace scree {

// A function that the library exports. It is looked for beside the program or Python module, built or installed, and else where
// the program's search path says, which is that of a project that found Scree. Once loaded it stays. Throws RunError if it is
// not there.
void* late_symbol(const std::string& library, const std::string& name);

template <class Function>
Function* late_function(const std::string& library, const std::string& name) {
  return reinterpret_cast<Function*>(late_symbol(library, name));
}

}  // namespace scree
