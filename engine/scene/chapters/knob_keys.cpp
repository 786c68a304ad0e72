// [[knob]] and [play]: what a page that computes (the verb `play`) lets its reader turn, and what it asks of
// him.
#include <fmt/format.h>
#include <optional>

#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;

// What the value of a knob measures; none for a key that no knob can have. engine/play/knobs.cpp has the
// knobs.
std::optional<Dimension> dimension_of(const std::string& key) {
    if (key.starts_with("species."))
        return key.ends_with(".diameter") ? std::optional(Dimension::length)
               : key.ends_with(".count")  ? std::optional(Dimension::number)
                                          : std::nullopt;
    const Key* known = find_key(key);
    if (known == nullptr) return std::nullopt;
    const bool is_number = known->kind == KeyKind::quantity || known->kind == KeyKind::integer ||
                           known->kind == KeyKind::gravity;
    return is_number ? std::optional(known->dimension) : std::nullopt;
}

void read_key(Document& document, const Scene&, const std::string& path, SceneKnob& knob) {
    knob.key = document.required_text(path);
    if (!dimension_of(knob.key))
        document.fail(
            path, fmt::format("is \"{}\", which no knob can turn; write for example \"drive.frequency\" or "
                              "\"species.NAME.count\"",
                              excerpt(knob.key)));
}

void read_range(Document& document, const Scene&, const std::string& path, SceneKnob& knob) {
    const auto range = document.interval(path, *dimension_of(knob.key));
    if (!range) return;
    if ((*range)[0] >= (*range)[1])
        document.fail(path, "must go from a smaller to a larger value; exchange the two");
    knob.range = *range;
}

std::string written_range(const SceneKnob& knob, const Scene&) {
    return fmt::format("[{}, {}]", as_toml((*knob.range)[0]), as_toml((*knob.range)[1]));
}

const KeyTable<SceneKnob>& knob_table() {
    static const KeyTable<SceneKnob> table{
        bound_by<SceneKnob>(
            entry("key", KeyKind::text, required(),
                  "The key that it turns: `drive.frequency`, `drive.g_level`, `contact.friction`, "
                  "`contact.restitution`, both also of `contact.wall`, `gravity`, `run.seed`, "
                  "`species.NAME.count` or `species.NAME.diameter`."),
            read_key, [](const SceneKnob& knob, const Scene&) { return quoted(knob.key); })
            .needed()
            .decides_nothing()
            .placed_at(-1),
        bound_by<SceneKnob>(entry("range", KeyKind::interval, note("a wide one"),
                                  "Its lowest and its highest value: `[\"5 Hz\", \"30 Hz\"]`."),
                            read_range, written_range)
            .unwritten_if([](const SceneKnob& knob) { return !knob.range; })
            .decides_nothing(),
        text("label", &SceneKnob::label, note("what it turns, in words"), "What stands beside it.")
            .unwritten_if([](const SceneKnob& knob) { return knob.label.empty(); })
            .decides_nothing(),
    };
    return table;
}

const KeyTable<Scene>& play_table() {
    static const KeyTable<Scene> table{
        text("challenge", &Scene::challenge, note("none"),
             "A line above the bed: \"Bring the big one up in 20 s\".")
            .unwritten_if([](const Scene& scene) { return scene.challenge.empty(); })
            .decides_nothing(),
    };
    return table;
}

}  // namespace

void list_knobs(Keys& all) {
    knob_table().list(all, "knob[]");
    play_table().list(all, "play");
}

void read_knobs(Document& document, Scene& scene) {
    knob_table().read_elements(document, scene, "knob", scene.knobs);
    play_table().read(document, scene, "play", scene);
}

void write_knobs(SceneText& out, const Scene& scene) {
    knob_table().write_elements(out, scene, "knob", scene.knobs);
    if (scene.challenge.empty()) return;
    out.table("play");
    play_table().write(out, scene, scene);
}

}  // namespace grainreel
