#include <cmath>

#include <pybind11/stl.h>

#include <map>
#include <mutex>

#include "tools/library/heating.h"
#include "tools/python/bindings.h"
#include "tools/python/views.h"
#include "tools/run/keys.h"

namespace scree::python {

namespace py = pybind11;

namespace {

// A heating of either dimension.
struct AnyHeating {
  using Two = std::unique_ptr<Heating<2>>;
  using Three = std::unique_ptr<Heating<3>>;
  std::variant<Two, Three> heating;
  // The temperatures of now in memory of their own: what time goes on with must not change under an array that somebody keeps.
  std::optional<py::array> now{};
  // Held by the thread that uses it; by one that computes, in its signal handlers, too.
  std::unique_ptr<std::recursive_mutex> in_use = std::make_unique<std::recursive_mutex>();

  template <class Use>
  decltype(auto) use(const Use& work) const {
    return std::visit([&](const auto& one) -> decltype(auto) { return work(*one); }, heating);
  }
};

// Whoever waits for its turn lets others run.
[[nodiscard]] std::unique_lock<std::recursive_mutex> turn(const AnyHeating& self) {
  const py::gil_scoped_release others_may_run;
  return std::unique_lock(*self.in_use);
}

// What was read before or meanwhile is of another time.
class Forgotten {
 public:
  explicit Forgotten(AnyHeating& heating) : heating_(heating) { heating_.now.reset(); }
  Forgotten(const Forgotten&) = delete;
  Forgotten& operator=(const Forgotten&) = delete;
  ~Forgotten() { heating_.now.reset(); }

 private:
  AnyHeating& heating_;
};

// A pile that was settled here is of its scene alone, as the packing in a run's folder; one from a file is whoever's names it.
void check_origin(const Scene& scene, const AnyPacking& packing) {
  const bool fell = scene.settle.has_value() && !packing.fall_key.empty();
  if (!fell || packing.fall_key == run::fall_key(scene)) return;
  Problem problem;
  problem.where.file = scene.file.string();
  problem.key = "packing";
  problem.value = "of another scene";
  problem.rule = "bodies, settle and what is mechanical in materials must be those it was settled with";
  problem.suggestion = "Settle this scene, or save the packing and load it";
  throw InputError(problem);
}

template <int dim>
std::unique_ptr<Heating<dim>> start(const Scene& scene, const AnyPacking& packing) {
  const auto* fitting = std::get_if<PlacedPacking<dim>>(&packing.packing);
  if (fitting == nullptr) throw py::value_error("the packing has another dimension than the scene");
  check_origin(scene, packing);
  return std::make_unique<Heating<dim>>(scene, fitting->packing);
}

std::unique_ptr<AnyHeating> heat(const SceneSource& source, const AnyPacking& packing) {
  const py::gil_scoped_release others_may_run;
  if (source.scene.dimension == 2) return std::make_unique<AnyHeating>(AnyHeating{start<2>(source.scene, packing)});
  return std::make_unique<AnyHeating>(AnyHeating{start<3>(source.scene, packing)});
}

void advance(AnyHeating& self, double time) {
  if (!std::isfinite(time)) throw py::value_error("the time must be a number");
  const auto alone = turn(self);
  const Forgotten before(self);
  const py::gil_scoped_release others_may_run;
  self.use([&](auto& heating) { heating.advance_to(time, [](double) { check_signals(); }); });
}

template <class Read>
auto state(const AnyHeating& self, const Read& read) {
  const auto alone = turn(self);
  return self.use([&](const auto& heating) { return read(heating.state()); });
}

py::array temperature(AnyHeating& self) {
  const auto alone = turn(self);
  if (!self.now) {
    self.now = own(self.use([](const auto& heating) { return heating.pile().places.in_packing(heating.temperature()); }));
  }
  return *self.now;
}

std::map<std::string, double> probes(const AnyHeating& self) {
  const auto alone = turn(self);
  return self.use([](const auto& heating) {
    std::map<std::string, double> values;
    for (const auto& probe : heating.pile().probes) values[probe.name] = heating.probe(probe.name);
    return values;
  });
}

// The scene's output times that are still to come, and the probes at them.
py::dict follow(AnyHeating& self) {
  const auto alone = turn(self);
  const Forgotten before(self);
  std::vector<double> times{state(self, [](const auto& now) { return now.time; })};
  std::map<std::string, std::vector<double>> values;
  for (const auto& [name, value] : probes(self)) values[name].push_back(value);
  self.use([&](auto& heating) {
    if (heating.scene().heat->time.steady) return;
    const py::gil_scoped_release others_may_run;
    const auto note = [&](double time, const std::vector<double>& of_probes) {
      times.push_back(time);
      for (std::size_t i = 0; i < of_probes.size(); ++i) values[heating.pile().probes[i].name].push_back(of_probes[i]);
    };
    heating.follow(note, [](double) { check_signals(); });
  });
  py::dict history;
  history["time"] = own(std::move(times));
  for (auto& [name, column] : values) history[name.c_str()] = own(std::move(column));
  return history;
}

// One member of every contact, from the heating's own memory.
template <class Number>
py::array contact_member(const py::object& self, auto member_of) {
  return self.cast<const AnyHeating&>().use([&](const auto& heating) {
    const auto& contacts = heating.pile().contacts.contacts;
    using Contact = std::decay_t<decltype(contacts.front())>;
    return member_view<Number>(contacts, member_of(Contact{}), 1, self);
  });
}

// A block of every contact, by its number in the packing.
py::array contact_blocks(const py::object& self, auto member_of) {
  return self.cast<const AnyHeating&>().use([&](const auto& heating) {
    std::vector<std::int32_t> blocks;
    for (const auto& contact : heating.pile().contacts.contacts)
      blocks.push_back(heating.pile().places.blocks[contact.*member_of(contact)].value());
    return own(std::move(blocks));
  });
}

py::array contact_points(const py::object& self) {
  return self.cast<const AnyHeating&>().use([&](const auto& heating) {
    const auto& pile = heating.pile();
    std::vector<double> coordinates;
    for (const auto& contact : pile.contacts.contacts) {
      const auto point = contact::point_of(pile.mesh, contact);
      coordinates.insert(coordinates.end(), point.begin(), point.end());
    }
    const std::size_t count = pile.contacts.contacts.size();
    return own(std::move(coordinates)).reshape({static_cast<py::ssize_t>(count), py::ssize_t{pile.mesh.corners - 1}});
  });
}

py::dict contacts(const py::object& self) {
  py::dict table;
  table["owner"] = contact_blocks(self, []<class C>(const C&) { return &C::owner; });
  table["target"] = contact_blocks(self, []<class C>(const C&) { return &C::target; });
  table["kind"] = contact_member<std::uint8_t>(self, []<class C>(const C&) { return &C::kind; });
  table["area"] = contact_member<double>(self, []<class C>(const C&) { return &C::area; });
  table["gap"] = contact_member<double>(self, []<class C>(const C&) { return &C::gap; });
  table["point"] = contact_points(self);
  return table;
}

}  // namespace

void bind_heating(py::module_& module) {
  py::class_<AnyHeating>(module, "Heating", "A packing that is heated, in memory.")
      .def(py::init(&heat), py::arg("scene"), py::arg("packing"),
           "Finds the contacts and assembles the balance of heat. A steady scene is solved here. Raises InputError for a "
           "packing that was settled from other bodies, and for one from a file whose bodies are others.")
      .def("advance_to", &advance, py::arg("time"), "Goes on to this time [s].")
      .def("follow", &follow,
           "Goes on to the scene's end; gives the probes at its output times, as a dict of arrays with 'time' [s].")
      .def_property_readonly(
          "time", [](const AnyHeating& self) { return state(self, [](const auto& now) { return now.time; }); },
          "How far it is [s].")
      .def_property_readonly(
          "temperature", &temperature,
          "Of every node of the packing now [K], NaN in blocks that left the scene; stays as it is when time goes on.")
      .def_property_readonly("probes", &probes, "Temperature at every probe now [K].")
      .def_property_readonly(
          "contacts", &contacts,
          "Every contact as arrays: kind (0 point-face, 1 edge-edge, 2 overlap), area [m2] and gap [m], which "
          "look into the heating's memory; owner and target (blocks of the packing) and point [m], copies.")
      .def_property_readonly(
          "contact_flows",
          [](const AnyHeating& self) {
            const auto alone = turn(self);
            return own(self.use([](const auto& heating) { return heating.contact_flows(); }));
          },
          "Heat flow from owner to target of every contact now [W].")
      .def_property_readonly(
          "time_error", [](const AnyHeating& self) { return state(self, [](const auto& now) { return now.time_error; }); },
          "Estimate of the time error so far [K].")
      .def_property_readonly(
          "lumping_error",
          [](const AnyHeating& self) { return state(self, [](const auto& now) { return now.lumping.largest; }); },
          "Estimate of what lumping blocks has changed so far [K]; 0 if none is lumped.")
      .def_property_readonly(
          "ledger_residual",
          [](const AnyHeating& self) { return state(self, [](const auto& now) { return now.ledger.relative_residual(); }); },
          "Heat that is missing in the balance, over the heat that flowed.")
      .def_property_readonly(
          "heat_stored", [](const AnyHeating& self) { return state(self, [](const auto& now) { return now.ledger.stored; }); },
          "Heat that the blocks hold more than at the start [J].");
}

}  // namespace scree::python
