// The keys of [start].
#include <fmt/format.h>

#include <filesystem>

#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Method = Start::Method;

const Words<Method> method_words{
    {"layers", Method::layers}, {"rain", Method::rain}, {"file", Method::file}, {"grains", Method::grains}};

constexpr std::size_t longest_path = 4096;  // as Linux has it

const char* without_file(const Start& start) {
    return start.method != Method::file ? "the start is not from a file" : nullptr;
}

const char* without_settling(const Start& start) {
    if (start.packs()) return nullptr;
    return start.method == Method::file ? "a bed from a file settles by itself where it must"
                                        : "grains placed by hand do not settle";
}

const char* without_packing(const Start& start) {
    return start.packs() ? nullptr : "only layers and rain fill a box";
}

const KeyTable<Region>& region_table() {
    using R = Region;
    static const KeyTable<R> table{
        vector("low", &R::low, Dimension::length, required(), "Lowest corner."),
        vector("high", &R::high, Dimension::length, required(), "Highest corner."),
    };
    return table;
}

BoundKey<Start> region_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, Start& start) {
        if (!document.has(path)) return;
        if (!document.is_table(path))
            document.fail(path,
                          fmt::format("is {}; write {{ low = [-0.1, -0.1, 0], high = [0.1, 0.1, 0.2] }}",
                                      document.written_value(path)));
        Region region;
        region_table().read(document, scene, path, region);
        check_corners(document, path, region.low, region.high);
        start.region = region;
    };
    return bound_by<Start>(entry("region", KeyKind::text, note("the container's room"),
                                 "Or a table: a box to pack the grains in, also where there is no container; "
                                 "layers and rain only."),
                           read,
                           [](const Start& start, const Scene& scene) {
                               return start.region ? region_table().inline_text(scene, *start.region)
                                                   : std::string();
                           })
        .useless_for(without_packing)
        .holding(region_table());
}

const char* without_rain(const Start& start) {
    return start.method != Method::rain ? "only rain has a rate" : nullptr;
}

// Throws UserError where grains are listed and the start is something else.
void check_listed(Document& document, const Start& start) {
    if (!start.grains.empty() && start.method != Method::grains)
        document.fail("start.method",
                      "must be \"grains\" where grains are listed; remove it or the [[grain]]s");
}

BoundKey<Start> file_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, Start& start) {
        check_listed(document, start);
        const std::filesystem::path file = document.required_text(path);
        const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
        start.file = std::filesystem::absolute(folder / file).lexically_normal().string();
        if (const std::string wrong = complaint_of_utf8(start.file); !wrong.empty())
            document.fail(path, fmt::format("lies at {}; rename the folder", wrong));
    };
    return bound_by<Start>(
               of_length(entry("file", KeyKind::text, note("required; file"),
                               "Checkpoint or final.csv of an earlier run, relative to the scene's folder; "
                               "stiffness and histories follow from it (docs/guide/again.md)."),
                         longest_path),
               read, [](const Start& start, const Scene&) { return quoted(start.file); })
        .excludes({"settle_limit", "settle_damping"})
        .useless_for(without_file);
}

const KeyTable<Start>& start_table() {
    using S = Start;
    static const KeyTable<S> table{
        choice("method", &S::method, method_words, note("layers; grains with [[grain]]"),
               "Grow and settle layers in the room before all planes, the species of the "
               "largest grains at the bottom; rain, all species mixed; go on from a file; or the grains as "
               "listed, at once.")
            .usually([](S& start, const Scene&) {
                start.method = start.grains.empty() ? Method::layers : Method::grains;
            }),
        file_key(),
        flag("keep_clock", &S::keep_clock, initial(), "Go on at the checkpoint's step and phase; file only.")
            .useless_for(without_file),
        quantity("settle_limit", &S::settle_limit, Dimension::time, positive, literal("\"5 s\""),
                 "Settling ends here at the latest; layers and rain only.")
            .useless_for(without_settling),
        quantity("settle_damping", &S::settle_damping, Dimension::rate, not_negative, literal("\"10 1/s\""),
                 "Drag on every grain while settling only; layers and rain only.")
            .useless_for(without_settling),
        quantity("rain_rate", &S::rain_rate, Dimension::rate, positive,
                 note("a thin rain, chosen by the plan"),
                 "Grains a second that appear above the bed; rain only.")
            .useless_for(without_rain),
        region_key(),
    };
    return table;
}

}  // namespace

void list_start(Keys& all) {
    start_table().list(all, "start");
}

void read_start(Document& document, Scene& scene) {
    Start& start = scene.start;
    start_table().read(document, scene, "start", start);
    check_listed(document, start);
    if (start.grains.empty() && start.method == Method::grains)
        document.fail("start.method", "is \"grains\", but none is listed; write [[grain]] and its position");
    // A box of one's own may lie on meshes or planes.
    const bool none = scene.container.shape == Container::Shape::none && !start.region;
    if (start.method == Method::layers && none)
        document.fail(
            "container.shape",
            fmt::format("is \"none\", so nothing holds layers; list the grains or start from a file{}",
                        scene.meshes.empty() ? "" : ", or say where to put them by start.region"));
    if (start.method != Method::rain) return;
    if (none) document.fail("container.shape", "is \"none\", so nothing holds the rain; list the grains");
    if (scene.gravity.z() >= 0)
        document.fail("start.method", "is \"rain\", but gravity does not pull it down; write \"layers\"");
}

void write_start(SceneText& out, const Scene& scene) {
    out.table("start");
    start_table().write(out, scene, scene.start);
}

}  // namespace grainreel
