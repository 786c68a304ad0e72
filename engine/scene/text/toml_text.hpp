// Writes values as TOML, and puts the text of a scene file together from them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/text.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

// The shortest decimals that read back to the same bits, and that TOML takes for a float.
std::string toml_number(double value);
std::string quoted(const std::string& text);
// "[1.0, 2.0]", from values that are TOML already.
std::string toml_list(const std::vector<std::string>& values);
std::string names_text(const std::vector<std::string>& names);  // a list of quoted words; "" for none

// The value in the dimension's unit; "" for a value that is not there.
std::string as_toml(double value, Dimension dimension = Dimension::number);
std::string as_toml(const Vec3& value, Dimension dimension = Dimension::number);
std::string as_toml(const std::string& value, Dimension = Dimension::number);
inline std::string as_toml(bool value, Dimension = Dimension::number) {
    return value ? "true" : "false";
}
inline std::string as_toml(int value, Dimension = Dimension::number) {
    return std::to_string(value);
}
inline std::string as_toml(std::int64_t value, Dimension = Dimension::number) {
    return std::to_string(value);
}
inline std::string as_toml(std::uint64_t value, Dimension = Dimension::number) {
    return std::to_string(value);
}
template <class V>
std::string as_toml(const std::optional<V>& value, Dimension dimension = Dimension::number) {
    return value ? as_toml(*value, dimension) : "";
}

// The scene file, table by table.
class SceneText {
  public:
    void table(std::string_view name) { text_ += "\n[" + std::string(name) + "]\n"; }
    void element(std::string_view name) { text_ += "\n[[" + std::string(name) + "]]\n"; }
    void comment(const std::string& words) { text_ += "# " + visible(words) + "\n"; }
    // Puts a comment above the next key of that name.
    void remark(const std::string& key, const std::string& words) { remarks_[key] = words; }
    // value is TOML; where it is empty the key is left out.
    void put(const std::string& key, const std::string& value);
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
    std::map<std::string, std::string> remarks_;
};

// Carries comments over to a scene file that is written again. Both texts must come from the writer of
// scenes, which writes one key on a line. A comment above a key in `before` is put above the same key in
// `text` if its value is the same and it has no comment yet.
std::string with_comments_of(std::string_view before, std::string text);

}  // namespace grainreel
