// A folder with the small scene and studies of it.
#pragma once

#include <string>

#include "render/app/study/file/read_study.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

inline const std::string small_study = R"(scene = "fifty.toml"
seeds = 2
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[vary]]
key = "species.big.diameter"
from = "5 mm"
to = "6 mm"
count = 3
[[measure]]
column = "kinetic"
reduce = "mean"
[[measure]]
name = "rise"
column = "height_difference"
reduce = "end"
[[chart]]
y = "rise"
)";

// The text with one of its lines replaced.
inline std::string with_line(std::string text, const std::string& line, const std::string& other) {
    const auto at = text.find(line);
    return at == std::string::npos ? "" : text.replace(at, line.size(), other);
}

class StudyFolderOfTest {
  public:
    StudyFolderOfTest() { write_small_scene(folder_.path()); }
    std::filesystem::path write(const std::string& text) const {
        write_text(folder_ / "study.toml", text);
        return folder_ / "study.toml";
    }
    Study read(const std::string& text) const { return read_study(write(text)); }
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    const std::filesystem::path& path() const { return folder_.path(); }

  private:
    TemporaryFolder folder_;
};

}  // namespace grainreel::test
