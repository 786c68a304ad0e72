// Small scenes for the tests of reader, plan and writer.
#pragma once

#include <string>

#include "engine/measure/columns.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {

inline const std::string wedge_text = test::shared_scene("wedge");

// A scene without drive and gravity: two kinds of grains are in a box, and law and stiffness are given.
inline const std::string box_text = test::shared_scene("box");

// `text` with `from` replaced by `to`; fails the test when `from` is not in it.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    return at == std::string::npos ? throw std::logic_error("no '" + from + "' in the scene")
                                   : text.replace(at, from.size(), to);
}

inline FilmedScene read_text(const std::string& text, const Assignments& sets = {}) {
    return read_filmed_scene_text(text, "test.toml", sets, measurable_in);
}

// A scene with two grains placed by hand in empty space, and a plane that comes nearer.
inline const std::string exact_text = test::shared_scene("two_grains");

}  // namespace grainreel
