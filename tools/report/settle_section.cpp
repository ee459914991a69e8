#include "tools/report/settle_section.h"

#include <fmt/format.h>

namespace scree::report {

namespace {

std::string metres(const Json& json, const std::string& key) {
  return figure(number(json, key)) + " m";
}

std::string repose(const Json& certificate) {
  if (certificate.at("angle_of_repose_degrees").is_null())
    return "none: walls hold the pile, or it is too small, too flat or no single round heap";
  return fmt::format("{} degrees (fit {})", figure(number(certificate, "angle_of_repose_degrees")),
                     value_or(certificate, "angle_of_repose_fit", "not known"));
}

void add_bulk(Rows& rows, const Json& certificate) {
  const Json& porosity = certificate.at("porosity");
  if (porosity.is_null()) {
    rows.push_back({"porosity", "the pile is too small to have an inside"});
  } else {
    rows.push_back({"porosity", figure(number(porosity, "value"))});
    rows.push_back({"solid fraction", figure(number(porosity, "solid_fraction"))});
    rows.push_back({"measured by", escaped(text(porosity, "method"))});
  }
  const Json& coordination = certificate.at("coordination");
  rows.push_back({"neighbours of a block inside", value_or(coordination, "mean", "-")});
  rows.push_back({"neighbours of a block anywhere", value_or(coordination, "mean_of_all", "-")});
  rows.push_back({"height", metres(certificate, "height")});
  rows.push_back({"angle of repose", repose(certificate)});
}

void add_forces(Rows& rows, const Json& certificate) {
  if (const Json& balance = certificate.at("force_balance"); !balance.is_null()) {
    rows.push_back({"net force on a block over its weight",
                    fmt::format("mean {}, largest {}; below a hundredth on {} of {} blocks", figure(number(balance, "mean")),
                                figure(number(balance, "largest")), figure(number(balance, "within_a_hundredth")),
                                figure(number(balance, "blocks")))});
  }
  for (const auto& [key, name] :
       {std::pair("penetrations", "overlap of touching pairs"), std::pair("gaps", "gap of touching pairs")}) {
    const Json& distances = certificate.at(key);
    rows.push_back({name, fmt::format("{} pairs, mean {}, largest {}", figure(number(distances, "pairs")),
                                      metres(distances, "mean"), metres(distances, "largest"))});
  }
}

void add_contacts(Page& page, const Json& certificate) {
  double all = 0;
  for (const auto& [kind, count] : certificate.at("contacts").items()) {
    if (kind != "with_fixed") all += count.get<double>();
  }
  Rows rows{{"pairs of blocks that touch", "", "share"}};
  for (const auto& [kind, name] : {std::pair("face_face", "face - face"), std::pair("face_edge", "face - edge"),
                                   std::pair("face_point", "face - point"), std::pair("edge_edge", "edge - edge"),
                                   std::pair("edge_point", "edge - point"), std::pair("point_point", "point - point")}) {
    const double count = number(certificate.at("contacts"), kind);
    rows.push_back({name, figure(count), all > 0 ? fmt::format("{:.0f} %", 100 * count / all) : "-"});
  }
  page.table(rows);
}

}  // namespace

void add_settle(Page& page, const Json& settle) {
  page.heading("Settling certificate");
  const bool at_rest = settle.value("at_rest", false);
  page.paragraph(fmt::format("{} after {} s: {}.", at_rest ? "At rest" : "<strong>Not at rest</strong>",
                             figure(number(settle, "simulated_time")), escaped(text(settle, "criterion"))));
  Rows rows{{"root mean square speed", figure(number(settle, "rms_speed")) + " m/s"},
            {"unbalanced force", figure(number(settle, "unbalanced_force"))},
            {"largest overlap", metres(settle, "max_penetration")},
            {"deepest overlap during the fall, over the smaller block", figure(number(settle, "deepest_overlap"))},
            {"lost blocks", figure(number(settle, "lost_blocks"))},
            {"settle stage", settle.value("reused", false) ? "reused" : "run"}};
  if (!settle.contains("certificate")) return page.facts(rows);
  const Json& certificate = settle.at("certificate");
  add_bulk(rows, certificate);
  add_forces(rows, certificate);
  rows.push_back({"hash of where the blocks lie", escaped(text(certificate, "packing_hash"))});
  page.facts(rows);
  add_contacts(page, certificate);
}

}  // namespace scree::report
