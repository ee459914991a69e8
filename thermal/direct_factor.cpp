#include "thermal/direct_factor.h"

#include "engine/base/late_library.h"

namespace scree::thermal {

namespace {

std::unique_ptr<DirectFactor> made_by(const char* name) {
  return std::unique_ptr<DirectFactor>(late_function<DirectFactor*()>("libscree_factor.so", name)());
}

}  // namespace

std::unique_ptr<DirectFactor> make_cholesky() {
  return made_by("scree_make_cholesky");
}

std::unique_ptr<DirectFactor> make_lu() {
  return made_by("scree_make_lu");
}

}  // namespace scree::thermal
