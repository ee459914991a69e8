#include "engine/base/hdf5_handle.h"

#include <type_traits>

#include <hdf5.h>

namespace scree {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>, "as Hdf5Handle takes them");

void hdf5_expect(bool holds, const std::string& what) {
  if (!holds) throw Hdf5Error(what);
}

void keep_hdf5_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Handle hdf5_text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a type of texts");
  hdf5_expect(H5Tset_size(type.id(), size) >= 0, "a type of texts");
  return type;
}

}  // namespace scree
