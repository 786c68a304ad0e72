// Study files, of a small scene that lies beside them.
#include "engine/base/error.hpp"
#include "render/app/study/file/read_study.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainreel::fuzz {

namespace {

constexpr std::string_view small_scene = R"([[species]]
name = "small"
count = 100
diameter = "5 mm"
density = 2500
[[species]]
name = "big"
count = 10
diameter = "10 mm"
density = 2500
[contact]
restitution = 0.8
friction = 0.3
[container]
shape = "box"
width = "5 cm"
depth = "5 cm"
height = "20 cm"
[drive]
frequency = "20 Hz"
g_level = 3
[run]
duration = "2 s"
)";

void attempt_study(std::string_view bytes) {
    static const std::filesystem::path scene = scratch().write("scene.toml", small_scene);
    const std::filesystem::path file = scratch().write("study.toml", bytes);
    try {
        read_study(file);
    } catch (const UserError&) {
    }
}

}  // namespace

Target study_target() {
    return {"study", "study files", attempt_study};
}

}  // namespace grainreel::fuzz
