// Study files, of a small scene that lies beside them.
#include "engine/base/error.hpp"
#include "render/app/study/file/read_study.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel::fuzz {

namespace {

void attempt_study(std::string_view bytes) {
    static const std::filesystem::path scene = scratch().write("scene.toml", wedge_text);
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
