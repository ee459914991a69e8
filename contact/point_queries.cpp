#include "contact/point_queries.h"

#include <type_traits>

namespace scree::contact {

namespace {

// Bit i for lane i.
SCREE_INLINE std::uint64_t bits(const MaskOf<Quad>& mask) {
  std::uint64_t found = 0;
  for (int i = 0; i < numbers_in_quad; ++i) found |= static_cast<std::uint64_t>(mask[i]) & 1u << i;
  return found;
}
#ifdef SCREE_HAS_AVX2
SCREE_INLINE std::uint64_t bits(unsigned mask) {
  return mask;
}
#endif

}  // namespace

template <int dim>
void PointQueries<dim>::measure(double tolerance, double rounding) {
  near_ = on_rim_ = apart_ = 0;
  // What is behind the last of them is measured, too, and is of no matter.
  widely([&](auto bytes) SCREE_INLINED {
    using Some = std::conditional_t<bytes == sizeof(Octet), Octet, Quad>;
    for (std::size_t first = 0; first < count_; first += sizeof(Some) / sizeof(double)) {
      PointQuery<dim, Some> query;
      const auto* number = asked_.data();
      for_each_number(query, [&](Some& some) SCREE_INLINED { load(some, (*number++).data() + first); });
      const PointAnswer<dim, Some> answer = contact::measure<dim, Some>(query, tolerance, rounding);
      for (int corner = 0; corner < dim; ++corner) store(answer.on_target[corner], on_target_[corner].data() + first);
      for (int axis = 0; axis < dim; ++axis) store(answer.offset[axis], offset_[axis].data() + first);
      store(answer.gap, gap_.data() + first);
      store(answer.facing, facing_.data() + first);
      near_ |= bits(answer.near) << first;
      on_rim_ |= bits(answer.on_rim) << first;
      apart_ |= bits(answer.apart) << first;
    }
  });
}

template class PointQueries<2>;
template class PointQueries<3>;

}  // namespace scree::contact
