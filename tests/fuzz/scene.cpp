// Scene files. What could be read is written as a run's folder has it, and read again: the same text comes
// back.
#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainreel::fuzz {

namespace {

void attempt_scene(std::string_view bytes) {
    static const std::filesystem::path name = scratch().write("input.toml", "");
    try {
        read_filmed_scene_text(bytes, name, {}, measurable_in);
    } catch (const UserError&) {
    }
    std::string written;
    try {
        written = written_scene(read_scene_text(bytes, name, {}, measurable_in));
    } catch (const UserError&) {
        return;
    }
    const Scene again = read_scene_text(written, name, {}, measurable_in);
    GRAINREEL_CHECK(written_scene(again) == written);
}

}  // namespace

Target scene_target() {
    return {"scene", "scene files", attempt_scene};
}

}  // namespace grainreel::fuzz
