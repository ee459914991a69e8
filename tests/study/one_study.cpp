#include "tests/study/one_study.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/study/study_text.h"

namespace scree::test {

const char* const two_by_two = R"(
scene: scene.yaml
vary: [{key: contact.stiffness_factor, values: [1, 100]}]
ensemble: {key: settle.seed, members: 2}
report:
  - heat.probes.top.temperature
  - {column: warm, probe: top, reaches: 350 K}
  - settle.top
)";

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Ended shell(const std::string& command, const std::filesystem::path& folder) {
  const std::filesystem::path log = folder / "said";
  const int status = std::system((command + " > " + log.string() + " 2>&1").c_str());
  return {WEXITSTATUS(status), contents(log)};
}

OneStudy::OneStudy(const std::string& text) : file(study_file(falling_scene, text)), out(file.parent_path() / "out") {}

std::string OneStudy::command(const std::string& options) const {
  const std::string words = options.find("--json") == std::string::npos ? "--quiet " + options : options;
  return std::string(SCREE_PROGRAM) + " study " + file.string() + " --threads 1 --out " + out.string() + " " + words;
}

Ended OneStudy::run(const std::string& options) const {
  return shell(command(options), file.parent_path());
}

study::Table OneStudy::table() const {
  return study::read_table(out / "table.h5");
}

nlohmann::json OneStudy::summary(std::size_t row) const {
  return nlohmann::json::parse(contents(out / table().find("directory")->texts[row] / "summary.json"));
}

}  // namespace scree::test
