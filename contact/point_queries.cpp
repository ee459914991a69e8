#include "contact/point_queries.h"

namespace scree::contact {

namespace {

// Bit i for lane i.
SCREE_INLINE unsigned bits(const MaskOf<Quad>& mask) {
  unsigned found = 0;
  for (int i = 0; i < numbers_in_quad; ++i) found |= static_cast<unsigned>(mask[i]) & 1u << i;
  return found;
}

}  // namespace

template <int dim>
void PointQueries<dim>::measure(double tolerance) {
  // What is behind the last of them is measured, too, and is of no matter.
  widely([&]() SCREE_INLINED {
    for (std::size_t first = 0; first < count_; first += numbers_in_quad) {
      PointQuery<dim, Quad> query;
      const auto* number = asked_.data();
      for_each_number(query, [&](Quad& quad) SCREE_INLINED { load(quad, (*number++).data() + first); });
      const PointAnswer<dim, Quad> answer = contact::measure<dim, Quad>(query, tolerance);
      for (int corner = 0; corner < dim; ++corner) store(answer.on_target[corner], on_target_[corner].data() + first);
      store(answer.gap, gap_.data() + first);
      store(answer.facing, facing_.data() + first);
      states_[first / numbers_in_quad] = bits(answer.near) | bits(answer.on_rim) << 4 | bits(answer.apart) << 8;
    }
  });
}

template class PointQueries<2>;
template class PointQueries<3>;

}  // namespace scree::contact
