// Draws trails, lines of force and rings; sets the order in which all marks are drawn; writes their legend.
#include "render/picture/marks/marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/scene/text/units.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/film_pace.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

// A trail is as smooth as the mean over this many periods around each of its points: the bed's own, or one.
// Trails of fewer than four such times, and those without a drive, show the motion as it was.
double smoothing_time(const FilmedScene& scene) {
    if (!scene.drive.present) return 0;
    const double time = std::max(1, scene.film.periods) / scene.drive.frequency;
    return scene.film.shows.trails.duration >= 4 * time ? time : 0;
}

// Replaces each place by the mean of those that are at most `reach` older or younger. Towards both ends the
// reach goes to zero, so that the trail still ends at its grain.
void smooth(std::vector<Trails::Point>& path, double reach) {
    const std::vector<Trails::Point> raw = path;
    for (std::size_t i = 1; i + 1 < raw.size(); ++i) {
        const double within =
            std::min({reach, raw[i].age - raw.front().age, raw.back().age - raw[i].age}) * (1 + 1e-9);
        Vec3 sum = raw[i].at;
        double count = 1;
        const auto add = [&](std::size_t k) {
            if (std::abs(raw[k].age - raw[i].age) > within) return false;
            sum += raw[k].at, ++count;
            return true;
        };
        for (std::size_t k = i; k-- > 0 && add(k);) {
        }
        for (std::size_t k = i + 1; k < raw.size() && add(k); ++k) {
        }
        path[i].at = sum / count;
    }
}

}  // namespace

Trails::Trails(const FilmedScene& scene)
    : species_(scene.species.size(), false),
      grains_(scene.film.shows.trails.grains),
      duration_(scene.film.shows.trails.duration),
      smoothing_(smoothing_time(scene)),
      longest_jump_(scene.container.periodic_depth ? 0.5 * scene.container.depth
                                                   : std::numeric_limits<double>::infinity()) {
    for (const std::size_t species : scene.film.shows.trails.species) species_[species] = true;
}

bool Trails::chosen(std::int32_t id, std::int32_t species) const {
    return species_[species] || std::find(grains_.begin(), grains_.end(), id) != grains_.end();
}

void Trails::take(const State& frame) {
    if (!past_.empty() && frame.time == past_.front().time) return;
    if (!past_.empty() && frame.time < past_.front().time) past_.clear();
    PastFrame now{frame.time, {}, {}};
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (!chosen(frame.id[i], frame.species[i])) continue;
        now.id.push_back(frame.id[i]);
        now.at.push_back(frame.position[i]);
    }
    past_.push_front(std::move(now));
    const double oldest = frame.time - duration_ * (1 + 1e-9);
    while (past_.back().time < oldest) past_.pop_back();
}

std::vector<std::vector<Trails::Point>> Trails::paths() const {
    std::vector<std::vector<Point>> paths;
    if (past_.empty()) return paths;
    const PastFrame& now = past_.front();
    for (const std::int32_t id : now.id) {
        std::vector<Point> path;
        for (const PastFrame& moment : past_) {
            const auto row = row_of_id(moment.id, id);
            if (!row) break;
            const Vec3& at = moment.at[*row];
            if (!path.empty() && std::abs(at.x() - path.back().at.x()) > longest_jump_) break;
            path.push_back({(now.time - moment.time) / duration_, at});
        }
        if (smoothing_ > 0) smooth(path, smoothing_ / duration_);
        paths.push_back(std::move(path));
    }
    return paths;
}

namespace {

// Contacts whose force is a smaller share of widest_force() get no line.
constexpr double weakest_force = 0.02;

}  // namespace

bool has_marks(const FilmShows& look) {
    return look.colour.of_field() || look.force_chains || look.trails.wanted() || look.arrows.across > 0 ||
           look.streamlines.across > 0 || look.wall_forces.wanted || !look.highlighted.empty() ||
           look.highlight_if.wanted();
}

double widest_force(const FilmedScene& scene) {
    return widest_chain_force(scene);
}

double widest_line(int picture_height) {
    return 0.01 * picture_height;
}

Marks::Marks(const FilmedScene& scene, const Palette& palette)
    : scene_(scene),
      palette_(palette),
      pen_(mark_pen(scene.film.height)),
      flow_(scene, palette),
      trails_(scene),
      condition_(scene, scene.film.shows.highlight_if.of) {
    if (scene.film.shows.colour.of_field()) field_.emplace(scene);
    if (scene.film.shows.wall_forces.wanted) wall_forces_.emplace(scene, palette);
}

void Marks::start_from(const State& frame) {
    condition_.start_from(frame);
    if (field_) field_->start_from(frame);
}

void Marks::remember(const State& frame) {
    if (scene_.film.shows.trails.wanted()) trails_.take(frame);
}

void Marks::draw(const View& view, const Shot& frame, const SeenShare& seen, Shapes& on) {
    const FilmShows& look = scene_.film.shows;
    if (field_) field_->draw(view, frame, on);
    if (look.force_chains) draw_chains(view, frame, on);
    remember(frame);
    if (look.trails.wanted()) draw_trails(view, on);
    flow_.draw(view, frame, on);
    if (wall_forces_) wall_forces_->draw(view, frame, on);
    if (!look.highlighted.empty() || look.highlight_if.wanted()) draw_rings(view, frame, seen, on);
}

void Marks::outlined(Shapes& on, const std::vector<Pixel>& points, bool closed, double width,
                     const Colour& colour, double strength) const {
    on.line(points, closed, width + 2 * pen_, {palette_.background, strength});
    on.line(points, closed, width, {colour, strength});
}

void Marks::draw_chains(const View& view, const Shot& frame, Shapes& on) const {
    const double widest = widest_line(scene_.film.height), force = widest_force(scene_);
    const double too_far = scene_.container.periodic_depth ? 0.5 * scene_.container.depth
                                                           : std::numeric_limits<double>::infinity();
    for (const Link& touch : frame.touches) {
        const auto first = frame.row_of(touch.first), second = frame.row_of(touch.second);
        if (!first || !second || touch.force < weakest_force * force) continue;
        const Vec3 &a = frame.position[*first], &b = frame.position[*second];
        if (std::abs(a.x() - b.x()) > too_far) continue;
        const double width = widest * std::min(1.0, touch.force / force);
        on.line({view.project(a), view.project(b)}, false, width, {palette_.force, 1});
    }
}

void Marks::draw_trails(const View& view, Shapes& on) const {
    for (const bool outline : {true, false}) {
        for (const auto& path : trails_.paths()) {
            for (std::size_t k = 1; k < path.size(); ++k) {
                // Trails are thinner where they are older.
                const double width = pen_ * (2.2 - 1.6 * path[k - 1].age);
                on.line({view.project(path[k - 1].at), view.project(path[k].at)}, false,
                        outline ? width + 1.4 * pen_ : width,
                        {outline ? palette_.background : palette_.accent, 1});
            }
        }
    }
}

// Grains chosen by id get rings wherever they are. Grains that a condition chooses get rings only where they
// are seen: in a bed with many such grains, rings around buried grains would seem to belong to other grains.
void Marks::draw_rings(const View& view, const Shot& frame, const SeenShare& seen, Shapes& on) {
    constexpr double kHidden = 0.02, kPlain = 0.2;  // seen shares between which a ring fades in
    const FilmShows& look = scene_.film.shows;
    for (const std::int32_t id : look.highlighted)
        if (const auto grain = frame.row_of(id))
            draw_ring(view, frame.position[*grain], frame.radius[*grain], 1, on);
    if (!look.highlight_if.wanted()) return;
    const std::vector<double>& values = condition_.of(frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const double over = values[i] - look.highlight_if.limit;
        if (look.highlight_if.above ? over <= 0 : over >= 0) continue;
        const double strength = std::clamp((seen(i) - kHidden) / (kPlain - kHidden), 0.0, 1.0);
        if (strength > 0) draw_ring(view, frame.position[i], frame.radius[i], strength, on);
    }
}

void Marks::draw_ring(const View& view, const Vec3& at, double grain_radius, double strength,
                      Shapes& on) const {
    constexpr int corners = 48;
    const Pixel middle = view.project(at);
    const double radius = grain_radius * view.pixels_per_metre(at) + 2.5 * pen_;
    outlined(on, circle_corners(middle, radius, corners), true, 2 * pen_, palette_.accent, strength);
}

namespace {

// A value with its unit, and between them a space at which no line breaks.
std::string quantity_text(double value, Dimension dimension) {
    const std::string unit = fitting_unit(value * 1.0000001, dimension);
    return fmt::format("{:.3g}\u00a0{}", value / unit_size(unit, dimension), unit);
}

// The text with spaces at which no line breaks.
std::string unbroken(std::string text) {
    for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos;) text.replace(at, 1, "\u00a0");
    return text;
}

// Writes entries below each other. An entry is a sample of a mark with its words beside it.
class MarksLegend {
  public:
    MarksLegend(const Writer& writer, double x, double y, double wrap)
        : writer_(writer),
          pen_(std::max(1.0, writer.type.main / 14)),
          icon_(2.2 * writer.type.main),
          gap_(0.6 * writer.type.gap),
          x_(x),
          y_(y),
          wrap_(wrap) {}

    double pen() const { return pen_; }
    double height() const { return height_ > 0 ? height_ - gap_ : 0; }

    // An entry for a straight line of this width.
    void line(const Colour& colour, double width, const std::string& words) {
        entry(icon_, words, [&](double middle) { draw_line(colour, icon_, width, middle); });
    }
    void ring(const Colour& colour, const std::string& words) {
        entry(icon_, words, [&](double middle) {
            set_colour(writer_.on, colour);
            cairo_set_line_width(writer_.on, 1.4 * pen_);
            cairo_arc(writer_.on, x_ + 0.5 * icon_, middle, 0.5 * writer_.type.main, 0, 2 * std::numbers::pi);
            cairo_stroke(writer_.on);
        });
    }
    // An entry for an arrow of a round value. pixels: the length of one SI unit.
    void arrow(double pixels, Dimension dimension, const Colour& colour, double width,
               const std::string& words) {
        const double most = 0.28 * wrap_;
        const double value = round_length(std::max(1e-12, most / pixels)), reach = value * pixels;
        entry(most, fmt::format("{}, {}", quantity_text(value, dimension), words), [&](double middle) {
            const double head = std::min(3.5 * width, 0.5 * reach);
            draw_line(colour, reach - head, width, middle);
            cairo_move_to(writer_.on, x_ + reach, middle);
            cairo_line_to(writer_.on, x_ + reach - head, middle - 0.45 * head);
            cairo_line_to(writer_.on, x_ + reach - head, middle + 0.45 * head);
            cairo_close_path(writer_.on);
            cairo_fill(writer_.on);
        });
    }

  private:
    // sample(middle) draws a sample at this height, as wide as `reach`.
    template <class Sample>
    void entry(double reach, const std::string& words, const Sample& sample) {
        const double indent = std::max(reach, icon_) + gap_, text_wrap = std::max(1.0, wrap_ - indent);
        const TextSize text = measure_text(words, writer_.minor(), text_wrap, 5);
        const double row = std::max(text.height, 1.3 * writer_.type.main), top = y_ + height_;
        if (writer_.on) {
            cairo_new_path(writer_.on);
            sample(top + 0.5 * row);
        }
        writer_.write(x_ + indent, top + 0.5 * (row - text.height), words, writer_.minor(),
                      writer_.palette.ink, text_wrap, 5);
        height_ += row + gap_;
    }
    void draw_line(const Colour& colour, double reach, double width, double middle) const {
        set_colour(writer_.on, colour);
        cairo_set_line_width(writer_.on, width);
        grainreel::draw_line(writer_.on, x_, middle, x_ + reach, middle);
    }

    const Writer& writer_;
    const double pen_, icon_, gap_, x_, y_, wrap_;  // pixels
    double height_ = 0;
};

constexpr std::size_t most_named = 12;  // grains named in the legend

std::string words_of_rings(const FilmShows& look, const Wording& say) {
    std::string ringed;
    if (!look.highlighted.empty())
        ringed = look.highlighted.size() > most_named
                     ? say(Word::number_of_grains, {std::to_string(look.highlighted.size())})
                     : say(look.highlighted.size() > 1 ? Word::grains : Word::grain,
                           {fmt::format("{}", fmt::join(look.highlighted, ", "))});
    if (look.highlight_if.wanted()) ringed += (ringed.empty() ? "" : ", ") + look.highlight_if.text;
    return ringed;
}

// A mean's name with the words "over a period", or over as many as the film says.
std::string over_periods(const std::string& name, bool period, const Film& film) {
    if (!period) return name;
    return film.periods > 1 ? film.wording(Word::over_periods, {name, std::to_string(film.periods)})
                            : film.wording(Word::over_a_period, {name});
}

}  // namespace

TextSize marks_block(const Writer& writer, const FilmedScene& scene, double scale, double x, double y,
                     double wrap) {
    const FilmShows& look = scene.film.shows;
    if (!scene.film.word_kinds.legend) return {};
    const Palette& palette = writer.palette;
    const Wording& say = scene.film.wording;
    MarksLegend legend(writer, x, y, wrap);
    if (look.arrows.across > 0)
        legend.arrow(arrow_scale(scene) * scale, Dimension::speed, palette.ink, legend.pen(),
                     over_periods(say(Word::mean_velocity), look.arrows.period, scene.film));
    if (look.streamlines.across > 0)
        legend.line(
            palette.ink, widest_streamline(scene.film.height),
            say(Word::this_wide, {over_periods(say(Word::streamlines), look.streamlines.period, scene.film),
                                  quantity_text(look.streamlines.speed, Dimension::speed)}));
    if (look.wall_forces.wanted)
        legend.arrow(wall_force_scale(scene) * scale, Dimension::force, palette.wall_force,
                     1.7 * legend.pen(), say(Word::force_on_wall));
    if (look.trails.wanted())
        legend.line(palette.accent, 1.5 * legend.pen(),
                    say(Word::paths, {unbroken(time_span_text(look.trails.duration))}));
    if (look.force_chains)
        legend.line(palette.force, widest_line(scene.film.height),
                    say(Word::contact_force, {quantity_text(widest_force(scene), Dimension::force)}));
    if (const std::string ringed = words_of_rings(look, say); !ringed.empty())
        legend.ring(palette.accent, ringed);
    return {wrap, legend.height()};
}

}  // namespace grainreel
