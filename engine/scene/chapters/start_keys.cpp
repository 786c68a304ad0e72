// How grains come into a scene: the keys of [start], of [[grain]] and of [[feed]].

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"
#include "engine/scene/chapters/mesh_files.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;
using Method = Start::Method;

const ChoiceWords<Method> method_words{
    {"layers", Method::layers}, {"rain", Method::rain}, {"file", Method::file}, {"grains", Method::grains}};

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
                         kLongestPath),
               read, [](const Start& start, const Scene&) { return quoted(start.file); })
        .excludes({"settle_limit", "settle_damping"})
        .useless_for(without_file);
}

const KeyTable<Start>& start_table() {
    using S = Start;
    static const KeyTable<S> table{
        choice("method", &S::method, method_words, note("layers; grains with [[grain]]"),
               "layers are grown and settled in the room before all planes, the species of the largest "
               "grains at the bottom; rain has all species mixed; file goes on from a file; grains are "
               "placed as they are listed.")
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
    // A region may lie on meshes or planes.
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

// The keys of [[grain]].

namespace {

using namespace keys;

constexpr double same_size = 1e-6;  // relative: a diameter written by hand is not exact to the last bit

void read_species_of(Document& document, const Scene& scene, const std::string& path, ListedGrain& grain) {
    grain.species = species_named(document, scene, path);
}

BoundKey<ListedGrain> species_key() {
    return bound_by<ListedGrain>(entry("species", KeyKind::text, note("the first"),
                                       "The species of this grain. Each [[grain]] is "
                                       "placed by itself."),
                                 read_species_of, [](const ListedGrain& grain, const Scene& scene) {
                                     return quoted(scene.species[grain.species].name);
                                 });
}

enum Place { of_kind, of_motion };  // the order of reading and writing

const KeyTable<ListedGrain>& grain_table() {
    using G = ListedGrain;
    static const KeyTable<G> table{
        species_key().placed_at(of_kind),
        vector("position", &G::position, Dimension::length, required(), "Of the centre.")
            .placed_at(of_motion),
        vector("velocity", &G::velocity, Dimension::speed, initial(), "At the start.").placed_at(of_motion),
        vector("spin", &G::spin, Dimension::spin, initial(), "Angular velocity at the start.")
            .placed_at(of_motion),
        quantity("diameter", &G::diameter, Dimension::length, positive, note("the species' mean"),
                 "It must be within the spread of the species.")
            .usually([](G& grain, const Scene& scene) {
                grain.diameter = scene.species[grain.species].diameter.mean;
            })
            .placed_at(of_kind),
    };
    return table;
}

ListedGrain read_grain(Document& document, const Scene& scene, const std::string& path) {
    ListedGrain grain;
    grain_table().read(document, scene, path, grain);
    const SizeSpread& spread = scene.species[grain.species].diameter;
    if (grain.diameter < spread.smallest * (1 - same_size) ||
        grain.diameter > spread.largest * (1 + same_size))
        document.fail(path + ".diameter",
                      fmt::format("of {:.6g} m is outside its species' {:.6g} to {:.6g} m; widen the spread",
                                  grain.diameter, spread.smallest, spread.largest));
    return grain;
}

}  // namespace

void list_grains(Keys& all) {
    grain_table().list(all, "grain[]");
}

void read_grains(Document& document, Scene& scene) {
    const std::size_t listed = document.size("grain");
    if (listed == 0) return;
    for (Species& species : scene.species) species.count = 0;
    for (std::size_t i = 0; i < listed; ++i) {
        scene.start.grains.push_back(read_grain(document, scene, fmt::format("grain[{}]", i)));
        ++scene.species[scene.start.grains.back().species].count;
    }
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].count == 0 && !is_fed(document, s, scene.species[s].name) &&
            !is_glued(document, s, scene.species[s].name))
            document.fail(fmt::format("species[{}].name", s),
                          fmt::format("\"{}\" has no grain among those listed; add one or remove the species",
                                      excerpt(scene.species[s].name)));
}

void write_grains(SceneText& out, const Scene& scene) {
    grain_table().write_elements(out, scene, "grain", scene.start.grains);
}

// The keys of [[feed]].

namespace {

using namespace keys;

constexpr double default_box = 3;  // its height in largest diameters

BoundKey<Feed> fed_species_key() {
    return bound_by<Feed>(
        entry("species", KeyKind::text, note("the first"),
              "The species of the grains. They come during the run, one after the other at even intervals."),
        [](Document& document, const Scene& scene, const std::string& path, Feed& feed) {
            feed.species = species_named(document, scene, path);
        },
        [](const Feed& feed, const Scene& scene) { return quoted(scene.species[feed.species].name); });
}

const KeyTable<Feed>& feed_table() {
    using F = Feed;
    static const KeyTable<F> table{
        fed_species_key(),
        quantity("rate", &F::rate, Dimension::rate, positive, note("required, or `count` and `until`"),
                 "Grains a second."),
        integer("count", &F::count, 1, most_grains, note("no limit"), "How many grains it gives."),
        quantity("from", &F::from, Dimension::time, not_negative, literal("\"0 s\""),
                 "When it begins; the first grain comes an interval later."),
        quantity("until", &F::until, Dimension::time, positive, note("the run's end"), "When it ends."),
        vector("low", &F::low, Dimension::length, note("across the container, near its top"),
               "Lowest corner of the box in which the centres appear, at random; it does not move."),
        vector("high", &F::high, Dimension::length, note("across the container, at its top"),
               "Highest corner."),
        vector("velocity", &F::velocity, Dimension::speed, initial(),
               "The velocity with which grains "
               "appear."),
    };
    return table;
}

void settle_rate(Document& document, const std::string& path, Feed& feed) {
    if (feed.until && !clearly_more(*feed.until, feed.from))
        document.fail(path + ".until", fmt::format("of {:.6g} s is not later than 'from', {:.6g} s; raise it",
                                                   *feed.until, feed.from));
    if (feed.rate > 0) return;
    if (!feed.count) document.fail_missing(path + ".rate");
    if (!feed.until)
        document.fail(path + ".count", "says how many, but not how fast; add 'rate', or 'until'");
    feed.rate = static_cast<double>(*feed.count) / (*feed.until - feed.from);
}

// The default box is as wide as the container and lies just below its top.
void settle_box(Document& document, const Scene& scene, const std::string& path, Feed& feed) {
    const Container& c = scene.container;
    const bool low = document.has(path + ".low"), high = document.has(path + ".high");
    if (low != high) document.fail_missing(path + (low ? ".high" : ".low"));
    if (!low && c.shape == Container::Shape::none)
        document.fail(path, "needs a place where there is no container; add 'low' and 'high'");
    if (!low) {
        const double across = c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth;
        const double deep = default_box * scene.species[feed.species].diameter.largest;
        feed.low = Vec3(-across, -c.half_width, std::max(0.0, c.height - deep));
        feed.high = Vec3(across, c.half_width, c.height);
    }
    for (int k = 0; k < 3; ++k) {
        if (clearly_more(feed.low[k], feed.high[k]))
            document.fail(path + ".low", "lies beyond 'high' along x, y or z; exchange the two");
        feed.low[k] = std::min(feed.low[k], feed.high[k]);
    }
}

// Checks a feed's box, with all walls in their rest positions.
void check_box(Document& document, const Scene& scene, const FreeSpace& space, const std::string& path,
               const Feed& feed) {
    if (scene.container.shape == Container::Shape::none) return;
    const double radius = 0.5 * scene.species[feed.species].diameter.largest * (1 - kSameDecimals);
    constexpr int places = 21;  // along each axis
    for (int at = 0; at < places * places * places; ++at) {
        const Vec3 share = Vec3(at % places, at / places % places, at / (places * places)) / (places - 1);
        if (space.holds(feed.low + share.cwiseProduct(feed.high - feed.low), radius)) return;
    }
    document.fail(path, fmt::format("has no place inside the container for a grain of {:.6g} m across; move "
                                    "'low' and 'high', or leave them out",
                                    scene.species[feed.species].diameter.largest));
}

}  // namespace

bool is_fed(Document& document, std::size_t number, const std::string& name) {
    for (std::size_t i = 0; i < document.size("feed"); ++i) {
        const auto species = document.text(fmt::format("feed[{}].species", i));
        if (species ? *species == name : number == 0) return true;
    }
    return false;
}

void list_feeds(Keys& all) {
    feed_table().list(all, "feed[]");
}

void read_feeds(Document& document, Scene& scene) {
    feed_table().read_elements(document, scene, "feed", scene.feeds);
    if (scene.feeds.empty()) return;
    const FreeSpace space(scene);
    for (std::size_t i = 0; i < scene.feeds.size(); ++i) {
        const std::string path = fmt::format("feed[{}]", i);
        settle_rate(document, path, scene.feeds[i]);
        settle_box(document, scene, path, scene.feeds[i]);
        check_box(document, scene, space, path, scene.feeds[i]);
    }
}

void count_fed(Document& document, Scene& scene) {
    for (std::size_t i = 0; i < scene.feeds.size(); ++i) {
        const Feed& feed = scene.feeds[i];
        if (!clearly_less(feed.from, scene.run.duration))
            document.fail(fmt::format("feed[{}].from", i),
                          fmt::format("is {:.6g} s, but the run ends at {:.6g} s; begin earlier or lengthen "
                                      "run.duration",
                                      feed.from, scene.run.duration));
        scene.species[feed.species].fed += feed.due(scene.run.duration);
    }
}

void write_feeds(SceneText& out, const Scene& scene) {
    feed_table().write_elements(out, scene, "feed", scene.feeds);
}

}  // namespace grainreel
