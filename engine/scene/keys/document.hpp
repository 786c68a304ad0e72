// A TOML file as the reader of scenes sees it: values by key path ("species[1].count"), checked against the
// list of keys. Every message names its place in the file. Internal to the reader.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class Document {
  public:
    // `file` is the name in messages. `keys` are the keys that the file may have; they must outlive the
    // document. Throws UserError when the text is not UTF-8 or not TOML.
    Document(std::string_view text, std::string file, const std::vector<Key>& keys = scene_keys());

    // Applies one assignment from the command line. A key that excludes others (g_level and amplitude)
    // removes them from what the file says. Throws UserError where such a key was set by an assignment of the
    // same source: the command line, or one file. A key whose value changes removes the keys that belong to
    // the old value (as a colour map belongs to the quantity it shows). [] and {} remove a list of tables and
    // a table. Throws UserError when the place does not exist or the text is not UTF-8.
    void set(const Assignment& assignment);

    // Takes a table out of the document and returns it as TOML, ready to stand in a scene file; empty where
    // there is none. Throws UserError when the key is no table.
    std::string take_out(const std::string& table);
    // Throws at the first key that is not in the list, or that is a table and should be a value, or the other
    // way round.
    void check_keys() const;
    // Throws at the first key that nothing has read.
    void check_all_read() const;

    bool has(const std::string& path) const;
    std::size_t size(const std::string& path) const;  // number of elements of an array; 0 when absent
    bool is_table(const std::string& path) const;     // whether the value is an inline table
    bool is_array(const std::string& path) const;
    bool is_text(const std::string& path) const;
    std::string written_value(const std::string& path) const;  // as TOML, cut short; the key must be there

    // The value of a key, in its dimension's unit; none when absent. These functions throw UserError when
    // the value is not of the key's kind or outside its range.
    std::optional<double> quantity(const std::string& path);
    std::optional<double> quantity(const std::string& path, Dimension dimension);  // in a dimension that
                                                                                   // another key names
    std::optional<std::int64_t> integer(const std::string& path);
    std::optional<bool> flag(const std::string& path);
    std::optional<std::string> text(const std::string& path);  // also choices
    std::optional<Vec3> vector(const std::string& path);       // also gravity; each number is a quantity
    std::optional<std::vector<std::string>> names(const std::string& path);
    // Rows of a speed (m/s) and a number, at most kTablePoints; empty when absent.
    std::vector<std::array<double, 2>> speed_table(const std::string& path);
    std::optional<std::array<std::int64_t, 2>> two_integers(const std::string& path);
    // [low, high], each a quantity of this dimension.
    std::optional<std::array<double, 2>> interval(const std::string& path, Dimension dimension);
    std::vector<std::string> name_list(const std::string& path);      // empty when absent
    std::vector<std::int64_t> integer_list(const std::string& path);  // as above
    // Values of any kind as one line of TOML, from which an assignment can be made. Empty when absent.
    // value_list() throws UserError when the key is not a list, and value() when it is a list or a table.
    std::vector<std::string> value_list(const std::string& path);
    std::string value(const std::string& path);
    // A value of any kind as TOML; empty when absent.
    std::string as_it_stands(const std::string& path);

    double required_quantity(const std::string& path);
    std::string required_text(const std::string& path);

    // Throws with "'path' <what>" at the key's place.
    [[noreturn]] void fail(const std::string& path, const std::string& what) const;
    // Throws with "[table] lacks 'key', ..." at the table's place.
    [[noreturn]] void fail_missing(const std::string& path) const;
    // Throws when the key is there, and gives `reason` ("a box has no slanted walls").
    void refuse(const std::string& path, const std::string& reason) const;

    const std::map<std::string, Location>& written() const { return written_; }
    bool from_command_line(const std::string& path) const;
    std::string place(const std::string& path) const;  // "file:line:column"

  private:
    const toml::node* find(const std::string& path) const;
    const toml::node* read(const std::string& path);  // finds the value and remembers that it was read
    double number_in(const std::string& path, const toml::node& node, const Key& key) const;
    void check_characters(const std::string& path, const std::string& text) const;
    void check_bare_phase(const std::string& path, const toml::node& node) const;
    std::string written_value(const toml::node& node) const;
    void record(const std::string& path, const toml::node& node);
    void check_table(const std::string& path, const toml::table& table) const;
    void check_entry(const std::string& path, const toml::node& node) const;
    void check_read(const std::string& path, const toml::node& node) const;
    toml::node* step_into(toml::node& node, const std::string& part, const std::string& by);
    std::pair<toml::table*, std::string> table_for(const std::vector<std::string>& parts, const Location& by);
    void remove(toml::table& table, const std::string& table_path, std::string_view key);
    void remove_rivals(toml::table& table, const std::string& path, const std::string& place);
    void take_back(toml::table& table, const std::string& table_path, const std::string& key,
                   const toml::node& value);

    const std::vector<Key>* keys_;
    std::string file_;
    toml::table root_;
    std::map<std::string, Location> written_;
    std::set<std::string> read_;
};

}  // namespace grainreel
