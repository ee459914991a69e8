// Settles a small pile once and heats it with joints of several conductances.
//
// Usage: settle_once_heat_many SCENE, such as scenes/small_pile.yaml
#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/library/heating.h"
#include "tools/library/make_packing.h"
#include "tools/scene/read_scene.h"

namespace {

// The contact through which most heat flows.
const scree::contact::Contact<3>& busiest(const scree::Heating<3>& heating) {
  const std::vector<double> flows = heating.contact_flows();
  const auto most = std::max_element(flows.begin(), flows.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (most == flows.end()) throw std::runtime_error("no two blocks touch");
  return heating.pile().contacts.contacts[static_cast<std::size_t>(most - flows.begin())];
}

void sweep(const std::string& file) {
  const auto packing = scree::make_packing<3>(scree::read_scene(file));
  if (!packing.settled) throw std::runtime_error("the scene's blocks do not fall");
  fmt::print("{} blocks, {:.3f} m high\n", packing.mesh.blocks.size(), packing.settled->top);
  for (const int beta : {1, 10, 100}) {
    // Everything a scene file may say can be said here as well, checked in the same way.
    const auto scene = scree::read_scene(file, {"heat.until=1 h", fmt::format("contact.stiffness_factor={}", beta)});
    scree::Heating<3> heating(scene, packing);
    heating.advance_to(3600);
    const auto point = scree::contact::point_of(heating.pile().mesh, busiest(heating));
    fmt::print("beta {:4}: {:5.1f} degC inside after 1 h, {:.0f} kJ stored, most heat at [{:.3f} {:.3f} {:.3f}]\n", beta,
               heating.probe("inside") - 273.15, heating.state().ledger.stored / 1e3, point.x(), point.y(), point.z());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    sweep(argc > 1 ? argv[1] : "");
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
