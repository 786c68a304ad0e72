// Writes a list of keys as a JSON Schema. A tree of tables is made from the paths of the keys; each node
// becomes an object, and each key in it the schema of its value.
#include "engine/scene/keys/json_schema.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/lists.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::ordered_json;

// A number as a text may give it, which a unit may follow: "2.5e3 kg/m3".
constexpr const char* number_pattern = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*$)";
constexpr const char* quantity_pattern =
    R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(\s+\S.*|[^\s0-9.,].*)$)";

// A table of a scene file, and the key whose value stands in its place if there is one (outlet = "closed").
struct Table {
    std::string name;
    bool is_list = false;  // [[name]]
    const Key* key = nullptr;
    std::vector<Table> inside;

    Table& child(const std::string& wanted) {
        for (Table& table : inside)
            if (table.name == wanted) return table;
        inside.emplace_back();
        inside.back().name = wanted;
        return inside.back();
    }
};

// "film.plot[].y" -> film, plot (a list), y.
void put(Table& root, const Key& key) {
    Table* table = &root;
    std::istringstream parts(key.path);
    for (std::string part; std::getline(parts, part, '.');) {
        const bool is_list = part.ends_with("[]");
        if (is_list) part.resize(part.size() - 2);
        table = &table->child(part);
        table->is_list = table->is_list || is_list;
    }
    table->key = &key;
}

Json any_of(std::vector<Json> all) {
    if (all.size() == 1) return all.front();
    Json schema;
    schema["anyOf"] = std::move(all);
    return schema;
}

Json number_within(const Range& range) {
    Json schema{{"type", "number"}};
    if (range.infinite) return schema;  // inf is a number of TOML, but has no place in a schema
    if (std::isfinite(range.low)) schema[range.open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) schema["maximum"] = range.high;
    return schema;
}

// A number in SI, or a text with a unit.
Json quantity(const Key& key) {
    const bool has_unit = key.dimension != Dimension::number;
    const Json text{{"type", "string"}, {"pattern", has_unit ? quantity_pattern : number_pattern}};
    return any_of({number_within(key.bounds()), text});
}

Json list_of(const Json& items) {
    return {{"type", "array"}, {"items", items}};
}

Json list_of(const Json& items, int least, int most) {
    return {{"type", "array"}, {"items", items}, {"minItems", least}, {"maxItems", most}};
}

Json word_of_choices(const Key& key) {
    Json schema{{"type", "string"}};
    if (!key.choices.empty()) schema["enum"] = key.choices;
    return schema;
}

Json whole_number(const Range& range) {
    Json schema = number_within(range);
    schema["type"] = "integer";
    for (const char* bound : {"minimum", "maximum"})
        if (schema.contains(bound) && std::abs(schema[bound].get<double>()) < 9e15)
            schema[bound] = schema[bound].get<std::int64_t>();
    return schema;
}

Json vector_of(Key key) {
    key.range = Range{};  // a range is that of a length
    return list_of(quantity(key), 3, 3);
}

// What the value of a key may be.
Json value_schema(const Key& key) {
    const Json text{{"type", "string"}}, number{{"type", "number"}};
    switch (key.kind) {
        case KeyKind::quantity:
        case KeyKind::diameter:
            return quantity(key);
        case KeyKind::integer:
            return whole_number(key.range);
        case KeyKind::flag:
            return {{"type", "boolean"}};
        case KeyKind::text:
            return {{"type", "string"}, {"maxLength", key.most_letters}};
        case KeyKind::choice:
            return word_of_choices(key);
        case KeyKind::colour:
            return {{"type", "string"}, {"pattern", "^(#[0-9a-fA-F]{6}|[a-z][a-z -]*)$"}};
        case KeyKind::vector:
            return vector_of(key);
        case KeyKind::gravity:
            return any_of({quantity(key), vector_of(key)});
        case KeyKind::picture_size:
            return any_of({Json{{"type", "string"}, {"pattern", "^[0-9]+x[0-9]+$"}},
                           list_of(Json{{"type", "integer"}}, 2, 2)});
        case KeyKind::species_pair:
            return list_of(text, 2, 2);
        case KeyKind::speed_table:
            return list_of(list_of(any_of({number, text}), 2, 2));
        case KeyKind::interval:
            return list_of(any_of({number, text}), 2, 2);
        case KeyKind::name_list:
            return list_of(word_of_choices(key));
        case KeyKind::names_or_all:
            return any_of({Json{{"type", "boolean"}}, list_of(text)});
        case KeyKind::integer_list:
            return list_of(whole_number(key.range));
        case KeyKind::seeds:
            return any_of({whole_number(key.range), list_of(whole_number(key.range))});
        case KeyKind::value:
            return any_of({number, text, Json{{"type", "boolean"}}});
        case KeyKind::value_list:
            return {{"type", "array"}};
    }
    return Json::object();
}

// The default as JSON; null where no value stands for it, or where JSON has no such value (inf).
Json default_of(const Key& key) {
    if (key.fallback.empty() || key.fallback.find("inf") != std::string::npos) return nullptr;
    try {
        const toml::table parsed = toml::parse("value = " + key.fallback);
        std::ostringstream text;
        text << toml::json_formatter{parsed};
        return Json::parse(text.str())["value"];
    } catch (const std::exception&) {
        return nullptr;
    }
}

// What an editor shows beside the key.
std::string description(const Key& key) {
    std::string text = key.about;
    if (key.dimension != Dimension::number)
        text += fmt::format(" In {}, or as text with a unit: {}.", text_of(key.dimension).unit,
                            text_of(key.dimension).example);
    if (const std::string range = key.range.text(); !range.empty() && range != "finite")
        text += fmt::format(" Range: {}.", range);
    if (!key.fallback_note.empty()) text += fmt::format(" Default: {}.", key.fallback_note);
    return text;
}

void describe(Json& schema, const Key& key) {
    schema["description"] = description(key);
    if (const Json value = default_of(key); !value.is_null()) schema["default"] = value;
}

Json required(const std::vector<std::string>& names) {
    return {{"required", names}};
}

// The words after "required; " in the note on a default: "required; wedge, box" holds for these shapes alone.
std::vector<std::string> words_of_condition(const std::string& note) {
    constexpr std::string_view start = "required; ";
    std::vector<std::string> words;
    if (!note.starts_with(start)) return words;
    std::istringstream list(note.substr(start.size()));
    for (std::string word; std::getline(list >> std::ws, word, ',');) words.push_back(word);
    return words;
}

// The key of the table that chooses among these words, or null.
const Key* chooser_of(const Table& table, const std::vector<std::string>& words) {
    for (const Table& inner : table.inside) {
        if (inner.key == nullptr || inner.key->kind != KeyKind::choice) continue;
        const std::vector<std::string>& choices = inner.key->choices;
        const auto is_choice = [&](const std::string& word) { return contains(choices, word); };
        if (std::all_of(words.begin(), words.end(), is_choice)) return inner.key;
    }
    return nullptr;
}

// The rule that a table whose chooser has one of these words must have the key.
Json required_for(const std::string& name, const Key& chooser, const std::vector<std::string>& words) {
    const std::string by = name_of(chooser.path);
    Json condition{{"properties", Json{{by, Json{{"enum", words}}}}}, {"required", Json::array({by})}};
    return {{"if", condition}, {"then", required({name})}};
}

// Which keys a table must have, and which cannot stand together.
void add_required(Json& schema, const Table& table) {
    std::vector<std::string> always;
    Json rules = Json::array();
    for (const Table& inner : table.inside) {
        if (inner.key == nullptr) continue;
        const std::string& note = inner.key->fallback_note;
        if (note == "required") always.push_back(inner.name);
        const std::vector<std::string> words = words_of_condition(note);
        const Key* chooser = words.empty() ? nullptr : chooser_of(table, words);
        if (chooser != nullptr) rules.push_back(required_for(inner.name, *chooser, words));
        for (const std::string& rival : inner.key->excludes)
            rules.push_back(Json{{"not", required({inner.name, rival})}});
    }
    if (!always.empty()) schema["required"] = always;
    if (!rules.empty()) schema["allOf"] = rules;
}

Json schema_of(const Table& table);

Json object_of(const Table& table) {
    Json schema{{"type", "object"}, {"additionalProperties", false}};
    Json& properties = schema["properties"] = Json::object();
    for (const Table& inner : table.inside) properties[inner.name] = schema_of(inner);
    add_required(schema, table);
    return schema;
}

Json schema_of(const Table& table) {
    std::vector<Json> forms;
    if (table.key != nullptr) forms.push_back(value_schema(*table.key));
    if (!table.inside.empty()) {
        const Json object = object_of(table);
        forms.push_back(table.is_list ? list_of(object) : object);
    }
    Json schema = any_of(forms);
    if (table.key != nullptr) describe(schema, *table.key);
    return schema;
}

}  // namespace

std::string json_schema(const std::vector<Key>& keys, const std::string& title) {
    Table root;
    for (const Key& key : keys) put(root, key);
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    schema.update(object_of(root));
    return schema.dump(1) + "\n";
}

}  // namespace grainreel
