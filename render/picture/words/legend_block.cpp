// Which grains are which.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/scene/bed.hpp"
#include "render/picture/grains/grain_colours.hpp"
#include "render/picture/grains/lit_ball.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/writer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_species = 12;  // more are summed up in a last line

// The entries of a legend of which the first `shown` species have one each, and the others one together.
class Entries {
  public:
    Entries(const Writer& writer, const FilmedScene& scene, double wrap)
        : writer_(writer), scene_(scene), wrap_(wrap), icon_(1.5 * writer.type.main) {}

    std::size_t count(std::size_t shown) const { return shown + (shown < scene_.species.size() ? 1 : 0); }

    // In as many columns as there is room for.
    TextSize draw(std::size_t shown, double x, double y) const {
        const double gap = writer_.type.gap;
        double widest = 1;
        for (std::size_t i = 0; i < count(shown); ++i)
            widest = std::max(widest, measured().entry(i, shown, 0, 0, 0).width);
        const auto columns =
            static_cast<std::size_t>(std::max(1.0, std::floor((wrap_ + gap) / (widest + gap))));
        TextSize size;
        for (std::size_t first = 0; first < count(shown); first += columns) {
            double height = 0;
            for (std::size_t i = first; i < std::min(count(shown), first + columns); ++i) {
                const double left = static_cast<double>(i - first) * (widest + gap);
                const TextSize one = entry(i, shown, x + left, y + size.height, columns > 1 ? 0 : wrap_);
                size.width = std::max(size.width, left + one.width);
                height = std::max(height, one.height);
            }
            size.height += height + 0.4 * gap;
        }
        return size;
    }

    Entries measured() const { return {{nullptr, writer_.type, writer_.palette}, scene_, wrap_}; }

  private:
    // Where the number changes, how many there are at the start, and how many are fed in the course of the
    // run. A species may be there for the walls alone.
    std::vector<std::string> numbers_of(const Species& species) const {
        const std::string wide = diameter_text(species.diameter);
        if (species.all() == 0) return {fmt::format("{}, glued to walls", wide)};
        if (species.count == 0) return {fmt::format("{} × {}, fed", species.fed, wide)};
        const Container& container = scene_.container;
        const bool changes = species.fed > 0 || (container.outlet && !container.tray);
        std::vector<std::string> lines{
            fmt::format("{} × {}{}", species.count, wide, changes ? " at the start" : "")};
        if (species.fed > 0) lines.push_back(fmt::format("{} more are fed", species.fed));
        return lines;
    }

    // A ball of the species' colour and relative size, its name, and how many there are.
    TextSize entry(std::size_t i, std::size_t shown, double x, double y, double wrap) const {
        const double indent = icon_ + 0.5 * writer_.type.gap;
        const double text_wrap = wrap > 0 ? std::max(1.0, wrap - indent) : 0;
        TextSize size;
        const auto line = [&](const std::string& text, const TextStyle& style, const Colour& colour) {
            const TextSize part = writer_.write(x + indent, y + size.height, text, style, colour, text_wrap);
            size.width = std::max(size.width, indent + part.width);
            size.height += part.height;
        };
        if (i == shown) {
            line(fmt::format("and {} more", scene_.species.size() - i), writer_.minor(),
                 writer_.palette.faint_ink);
            return size;
        }
        const Species& species = scene_.species[i];
        line(species.name, writer_.main(), writer_.palette.ink);
        for (const std::string& numbers : numbers_of(species))
            line(numbers, writer_.minor(), writer_.palette.faint_ink);
        const bool by_species = scene_.film.shows.colour.by == GrainValue::species;
        const double share =
            std::max(0.25, species.diameter.largest / std::max(largest_diameter(scene_), 1e-30));
        if (writer_.on)
            draw_lit_ball(writer_.on, x + 0.5 * icon_, y + 0.5 * size.height, 0.5 * icon_ * share,
                          by_species ? scene_.colours[i] : neutral_grain);
        return size;
    }

    const Writer writer_;
    const FilmedScene& scene_;
    const double wrap_, icon_;
};

}  // namespace

std::size_t species_in_legend(const Writer& writer, const FilmedScene& scene, double wrap, double room) {
    const Entries entries = Entries(writer, scene, wrap).measured();
    std::size_t shown = std::min(scene.species.size(), most_species);
    while (shown > 0 && room > 0 && entries.draw(shown, 0, 0).height > room) --shown;
    return shown;
}

TextSize legend_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap,
                      double room) {
    if (!scene.film.word_kinds.legend) return {};
    const std::size_t shown = species_in_legend(writer, scene, wrap, room);
    return shown > 0 ? Entries(writer, scene, wrap).draw(shown, x, y) : TextSize{};
}

}  // namespace grainreel
