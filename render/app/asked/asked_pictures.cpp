#include "render/app/asked/asked_pictures.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/film/run/still.hpp"
#include "render/film/sources/stored_shots.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

using Json = nlohmann::json;

// Keeps the warnings about a picture.
class Notes final : public SilentListener {
  public:
    explicit Notes(const Reporter& reporter) : reporter_(reporter) {}
    void warning(const std::string& text) override { lines.push_back(text); }
    int stop_signal() const override { return reporter_.stop_signal(); }

    std::vector<std::string> lines;

  private:
    const Reporter& reporter_;
};

// A number of the question; null stands for one that is not known.
double number_of(const Json& value) {
    return value.is_null() ? kUnknown : value.get<double>();
}

// Sorts the values by their ids.
void sort_by_id(OwnColours& own) {
    std::vector<std::size_t> order(own.id.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return own.id[a] < own.id[b]; });
    OwnColours sorted = own;
    for (std::size_t i = 0; i < order.size(); ++i) {
        sorted.id[i] = own.id[order[i]];
        sorted.value[i] = own.value[order[i]];
    }
    own = std::move(sorted);
    if (std::adjacent_find(own.id.begin(), own.id.end()) != own.id.end())
        throw UserError("colour: a grain has two values; give each id once");
}

std::array<double, 2> range_of(const Json& range, bool logarithmic) {
    const std::array<double, 2> ends{number_of(range.at(0)), number_of(range.at(1))};
    if (!(std::isfinite(ends[0]) && std::isfinite(ends[1]) && ends[0] < ends[1]))
        throw UserError("film.colour.range: needs two numbers, the lower one first");
    if (logarithmic && !(ends[0] > 0))
        throw UserError("film.colour.range: must begin above 0, because the scale is logarithmic");
    return ends;
}

OwnColours own_colours(const Json& asked) {
    OwnColours own;
    own.colouring.by = GrainValue::own;
    own.colouring.title = asked.value("title", "");
    own.colouring.fixed = true;
    own.colouring.logarithmic = asked.value("logarithmic", false);
    own.colouring.range = range_of(asked.at("range"), own.colouring.logarithmic);
    const std::string map = asked.value("map", "viridis");
    const auto known = std::find_if(colour_map_words.begin(), colour_map_words.end(),
                                    [&](const auto& word) { return word.first == map; });
    if (known == colour_map_words.end()) throw UserError("film.colour.map: there is no map {}", excerpt(map));
    own.colouring.map = known->second;
    for (const Json& value : asked.at("value")) own.value.push_back(number_of(value));
    if (asked.contains("id")) own.id = asked.at("id").get<std::vector<std::int32_t>>();
    if (!own.id.empty() && own.id.size() != own.value.size())
        throw UserError("colour: has {} ids and {} values", own.id.size(), own.value.size());
    sort_by_id(own);
    return own;
}

// Draws for one question after the other. What was opened for the last one serves as long as its settings
// are the same.
class Desk {
  public:
    Desk(const FilmRequest& film, const RenderRequest& what, const Reporter& reporter)
        : film_(film), what_(what), notes_(reporter) {
        open({});
    }

    Json greeting() const { return {{"run", what_.run.string()}, {"last", last()}}; }

    void answer(const std::string& line) {
        notes_.lines.clear();
        const Json asked = Json::parse(line);
        const auto sets = asked.value("set", std::vector<std::string>{});
        if (sets != sets_) open(sets);
        RenderRequest what = what_;
        if (asked.contains("frame")) what.frame = asked.at("frame").get<std::int64_t>();
        if (asked.contains("cycle")) {
            what.cycle = asked.at("cycle").get<double>();
            what.phase = asked.value("phase", 0.0);
            what.at = time_of_cycle(what, source_->clock(), source_->span().to);
        } else if (!what.frame) {
            what.at = asked.contains("at") ? asked.at("at").get<double>() : last();
        }
        std::optional<OwnColours> own;
        if (asked.contains("colour")) own = own_colours(asked.at("colour"));
        if (const auto drawn = painter_->draw(what, own ? &*own : nullptr)) tell(*drawn);
    }

  private:
    double last() const { return source_->run().moments().back().time; }

    // Opens the run for other settings. The old ones stay where the new ones have a mistake.
    void open(const std::vector<std::string>& sets) {
        Assignments all = what_.sets;
        all.insert(all.end(), sets.begin(), sets.end());
        auto source = std::make_unique<StoredShots>(what_.run, sets_for_still(all), what_.replay);
        auto painter = std::make_unique<StillPainter>(*source, film_, what_.print, notes_,
                                                      painter_ ? painter_->context() : nullptr);
        painter_ = std::move(painter);
        source_ = std::move(source);
        sets_ = sets;
    }

    void tell(const StillPainter::Drawn& drawn) const {
        const Picture& picture = *drawn.picture;
        const Json head = {{"width", picture.width},
                           {"height", picture.height},
                           {"transparent", painter_->scene().film.transparent},
                           {"time", drawn.frame->time},
                           {"notes", notes_.lines}};
        print_exact(head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
        print_exact({reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size()});
    }

    const FilmRequest& film_;
    const RenderRequest& what_;
    Notes notes_;
    std::vector<std::string> sets_;
    std::unique_ptr<StoredShots> source_;
    std::unique_ptr<StillPainter> painter_;  // draws from source_, so it goes first
};

void tell_error(const std::string& text) {
    print_exact(Json{{"error", text}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

int draw_asked_pictures(const FilmRequest& film, const RenderRequest& what, const Reporter& reporter) {
    Desk desk(film, what, reporter);
    print_exact(desk.greeting().dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
    std::string line;
    while (std::fflush(stdout) == 0 && reporter.stop_signal() == 0 && std::getline(std::cin, line)) {
        try {
            desk.answer(line);
        } catch (const Json::exception& mistake) {
            tell_error(fmt::format("this is no question: {}", mistake.what()));
        } catch (const std::exception& mistake) {
            tell_error(words_of(mistake));
        }
    }
    return reporter.stop_signal() == 0 ? 0 : signal_base + reporter.stop_signal();
}

}  // namespace grainreel
