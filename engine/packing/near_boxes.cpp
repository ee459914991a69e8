#include "engine/packing/near_boxes.h"

#include <algorithm>

namespace scree::packing {

namespace {

// Strips of space, as wide as the boxes are in the mean. A box is in all strips that it reaches, and each strip has its boxes
// beside each other in memory, in the order in which they begin along it.
template <int dim>
class Strips {
 public:
  struct Entry {
    Aabb<dim> box;
    std::size_t number = 0;
  };

  Strips(const std::vector<Aabb<dim>>& boxes, double range) : range_(range) {
    Aabb<dim> all;
    for (const Aabb<dim>& box : boxes) all.extend(box);
    choose_axes(all.sizes());
    low_ = all.min()[across_];
    width_ = std::max(range, 0.0);
    for (const Aabb<dim>& box : boxes) width_ += box.sizes()[across_] / static_cast<double>(boxes.size());
    const double strips = std::min(all.sizes()[across_] / width_, static_cast<double>(boxes.size()));
    entries_.resize(static_cast<std::size_t>(strips) + 1);
    std::vector<Entry> order;
    for (std::size_t i = 0; i < boxes.size(); ++i) order.push_back({boxes[i], i});
    std::stable_sort(order.begin(), order.end(), [&](const Entry& a, const Entry& b) { return begin_of(a) < begin_of(b); });
    for (const Entry& entry : order) {
      const std::size_t last = strip_at(entry.box.max()[across_] + range);
      for (std::size_t s = strip_at(entry.box.min()[across_]); s <= last; ++s) entries_[s].push_back(entry);
    }
  }

  void look_through(const std::function<void(std::size_t, std::size_t)>& found) const {
    for (std::size_t s = 0; s < entries_.size(); ++s) {
      const std::vector<Entry>& strip = entries_[s];
      for (std::size_t i = 0; i < strip.size(); ++i) {
        const double end = strip[i].box.max()[along_] + range_;
        for (std::size_t j = i + 1; j < strip.size() && begin_of(strip[j]) <= end; ++j) {
          if (are_near(strip[i].box, strip[j].box) && first_of_both(strip[i].box, strip[j].box) == s) {
            found(strip[i].number, strip[j].number);
          }
        }
      }
    }
  }

 private:
  // Along which all boxes spread most, and next.
  void choose_axes(const Point<dim>& sizes) {
    sizes.maxCoeff(&along_);
    across_ = along_ == 0 ? 1 : 0;
    for (int axis = across_ + 1; axis < dim; ++axis) {
      if (axis != along_ && sizes[axis] > sizes[across_]) across_ = axis;
    }
  }

  [[nodiscard]] double begin_of(const Entry& entry) const { return entry.box.min()[along_]; }

  [[nodiscard]] std::size_t strip_at(double place) const {
    return static_cast<std::size_t>(std::clamp((place - low_) / width_, 0.0, static_cast<double>(entries_.size() - 1)));
  }

  [[nodiscard]] std::size_t first_of_both(const Aabb<dim>& a, const Aabb<dim>& b) const {
    return strip_at(std::max(a.min()[across_], b.min()[across_]));
  }

  [[nodiscard]] bool are_near(const Aabb<dim>& a, const Aabb<dim>& b) const {
    return ((a.min().cwiseMax(b.min()) - a.max().cwiseMin(b.max())).array() <= range_).all();
  }

  double range_;                // [m]
  int along_ = 0, across_ = 1;  // axes
  double low_ = 0, width_ = 0;  // of the first strip, of each [m]
  std::vector<std::vector<Entry>> entries_;
};

}  // namespace

template <int dim>
void for_near_boxes(const std::vector<Aabb<dim>>& boxes, double range,
                    const std::function<void(std::size_t, std::size_t)>& found) {
  if (!boxes.empty()) Strips<dim>(boxes, range).look_through(found);
}

template void for_near_boxes(const std::vector<Aabb<2>>&, double, const std::function<void(std::size_t, std::size_t)>&);
template void for_near_boxes(const std::vector<Aabb<3>>&, double, const std::function<void(std::size_t, std::size_t)>&);

}  // namespace scree::packing
