// Small scenes as text. A test writes what it is about in a few words, one after the other as in a scene
// file:
//     SmallScene().beads(60).contacts("0.8", "0.5").box("16 mm", "16 mm", "60 mm").shaken("20 Hz",
//     "3").lasts("1 s")
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

// A scene of tests/data/scenes, which scripts read too.
inline std::string shared_scene(const std::string& name) {
    return text_of(std::filesystem::path(GRAINREEL_SOURCE) / "tests/data/scenes" / (name + ".toml"));
}

// Fifty grains that pack and shake within a second or so; a box into which all grains come while the run goes
// on; and a scene of 0.1 s that has everything a resumed run must carry on: grains that come and leave,
// stages of the drive, fields, contacts, instruments and a film.
inline const std::string small_scene_text = shared_scene("fifty");
inline const std::string fed_scene_text = shared_scene("fed");
inline const std::string busy_scene_text = shared_scene("busy");

inline std::filesystem::path write_small_scene(const std::filesystem::path& folder) {
    write_text(folder / "fifty.toml", small_scene_text);
    return folder / "fifty.toml";
}

// Each value stands for what the scene file says: "4 mm" or "2500".
class SmallScene {
  public:
    explicit SmallScene(std::string top = "")
        : text_(std::move(top)) {}  // "gravity = 10\n", "title = \"two\"\n"

    // A species. A spread of diameters is "3 mm to 4 mm". count 0: none is written.
    SmallScene& beads(int count, const std::string& name = "beads", const std::string& diameter = "4 mm",
                      const std::string& density = "2500") {
        more("[[species]]\n").key("name", name);
        if (count > 0) key("count", std::to_string(count));
        return key("diameter", diameter).key("density", density);
    }
    SmallScene& contacts(const std::string& restitution, const std::string& friction) {
        return more("[contact]\n").key("restitution", restitution).key("friction", friction);
    }
    SmallScene& box(const std::string& width, const std::string& depth, const std::string& height) {
        return shape("box").key("width", width).key("depth", depth).key("height", height);
    }
    SmallScene& wedge(const std::string& half_angle, const std::string& slant_height,
                      const std::string& half_width, const std::string& depth, const std::string& height) {
        shape("wedge").key("half_angle", half_angle).key("slant_height", slant_height);
        return key("half_width", half_width).key("depth", depth).key("height", height);
    }
    SmallScene& cylinder(const std::string& diameter, const std::string& height) {
        return shape("cylinder").key("diameter", diameter).key("height", height);
    }
    SmallScene& empty_space() { return shape("none"); }
    SmallScene& shaken(const std::string& frequency, const std::string& g_level) {
        return more("[drive]\n").key("frequency", frequency).key("g_level", g_level);
    }
    SmallScene& lasts(const std::string& duration) { return more("[run]\n").key("duration", duration); }

    // Text of a scene file. It begins with more keys of the table that came last, or with a table of its own.
    SmallScene& more(const std::string& toml) {
        text_ += toml;
        return *this;
    }
    const std::string& text() const { return text_; }
    operator const std::string&() const { return text_; }

  private:
    SmallScene& shape(const std::string& name) { return more("[container]\n").key("shape", name); }
    SmallScene& key(const std::string& name, const std::string& value) {
        const std::size_t to = value.find(" to ");
        if (to != std::string::npos)
            return more(name + " = { min = \"" + value.substr(0, to) + "\", max = \"" + value.substr(to + 4) +
                        "\" }\n");
        const bool is_number = value.find_first_not_of("0123456789.") == std::string::npos;
        return more(name + " = " + (is_number ? value : '"' + value + '"') + "\n");
    }

    std::string text_;
};

}  // namespace grainreel::test
