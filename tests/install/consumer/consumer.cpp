// Heats the scene it is given and prints the temperature at its first probe [K].

#include <cstdio>

#include "tools/library/heating.h"
#include "tools/library/make_packing.h"
#include "tools/scene/read_scene.h"

int main(int, char** argv) {
  const scree::Scene scene = scree::read_scene(argv[1], {});
  scree::Heating<2> heating(scene, scree::make_packing<2>(scene));
  heating.advance_to(scene.heat->time.until);
  std::printf("%.3f\n", heating.probe(scene.probes.front().name));
}
