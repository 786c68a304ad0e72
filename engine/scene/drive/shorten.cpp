#include "engine/scene/drive/shorten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/scene/drive/stage_keys.hpp"

namespace grainreel {
namespace {

bool begins_too_late(double from, const Scene& scene) {
    return !clearly_less(from, scene.run.duration);
}

// A feed stays, to be refused, where its species has no other grains: neither at the start nor from a feed
// that begins in time.
void shorten_feeds(Scene& scene) {
    std::vector<bool> has_others;
    for (const Species& species : scene.species) has_others.push_back(species.count > 0);
    for (const Feed& feed : scene.feeds)
        if (!begins_too_late(feed.from, scene)) has_others[feed.species] = true;
    const auto dispensable = [&](const Feed& feed) {
        return begins_too_late(feed.from, scene) && has_others[feed.species];
    };
    leave_out(scene, std::erase_if(scene.feeds, dispensable), "feed", "feeds");
}

void shorten_outlet(Scene& scene) {
    Container& c = scene.container;
    if (!c.outlet || !begins_too_late(c.outlet->opens, scene)) return;
    c.outlet.reset();
    leave_out(scene, 1, c.tray ? "outlet and its tray" : "outlet", "");
    c.tray.reset();
}

}  // namespace

bool ends_early(const Document& document) {
    return document.from_command_line("run.duration");
}

void leave_out(Scene& scene, std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    const std::string begin = fmt::format("{}: the run ends at {:.6g} s, and goes without what comes later: ",
                                          scene.where("run.duration"), scene.run.duration);
    const std::string what = fmt::format("{} {}", count, count == 1 ? one : many);
    const auto said = std::find_if(scene.notes.begin(), scene.notes.end(),
                                   [&](const std::string& note) { return note.rfind(begin, 0) == 0; });
    if (said == scene.notes.end())
        scene.notes.push_back(begin + what);
    else
        *said += ", " + what;
}

void shorten(const Document& document, Scene& scene) {
    if (!ends_early(document)) return;
    leave_out(scene, shorten_stages(scene), "stage of the drive", "stages of the drive");
    shorten_feeds(scene);
    shorten_outlet(scene);
}

}  // namespace grainreel
