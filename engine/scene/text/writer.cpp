#include "engine/scene/text/writer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/scene/film/colours.hpp"
#include "engine/scene/film/grain_values.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

// The shortest decimals that read back to the same bits, and that TOML takes for a float.
std::string number(double value) {
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string vector(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

// Turns; those beyond one need their unit, without which the reader takes them for a mistake.
std::string phase(double turns) {
    return std::abs(turns) > 1 ? quoted(fmt::format("{} turn", turns)) : number(turns);
}

class SceneText {
  public:
    void table(const char* name) { text_ += fmt::format("\n[{}]\n", name); }
    void element(const char* name) { text_ += fmt::format("\n[[{}]]\n", name); }
    void comment(const std::string& words) { text_ += "# " + words + "\n"; }
    void put(const char* key, const std::string& value) { text_ += fmt::format("{} = {}\n", key, value); }
    void put(const char* key, double value) { put(key, number(value)); }
    void put(const char* key, const std::optional<double>& value) {
        if (value) put(key, *value);
    }
    void whole(const char* key, std::int64_t value) { put(key, fmt::format("{}", value)); }
    void flag(const char* key, bool value) { put(key, std::string(value ? "true" : "false")); }
    void words(const char* key, const std::string& value) { put(key, quoted(value)); }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

void write_species(SceneText& out, const Species& species, bool listed) {
    out.element("species");
    out.words("name", species.name);
    if (!listed) out.whole("count", species.count);
    const SizeSpread& d = species.diameter;
    switch (d.kind) {
        case SizeSpread::Kind::fixed:
            out.put("diameter", d.mean);
            break;
        case SizeSpread::Kind::uniform:
            out.put("diameter",
                    fmt::format("{{ min = {}, max = {} }}", number(d.smallest), number(d.largest)));
            break;
        case SizeSpread::Kind::normal:
            out.put("diameter",
                    fmt::format("{{ mean = {}, deviation = {} }}", number(d.mean), number(d.deviation)));
            break;
    }
    out.put("density", species.density);
    out.words("colour", colour_text(species.colour));
}

void write_pair(SceneText& out, const PairContact& pair, const PairPlan& plan, const std::string& other,
                const Species& species) {
    out.element("contact.pair");
    out.put("between", fmt::format("[{}, {}]", quoted(species.name), quoted(other)));
    const bool hertz = pair.normal == NormalLaw::hertz;
    out.words("law", word_of(pair.normal, normal_law_words));
    out.words("friction_law", word_of(pair.tangential, tangential_law_words));
    if (pair.normal != NormalLaw::walton_braun) out.flag("attraction", pair.attraction);
    if (pair.normal_damping) {
        out.put("normal_damping", pair.normal_damping);
    } else if (!pair.restitution_table.empty()) {
        std::vector<std::string> rows;
        for (const RestitutionPoint& p : pair.restitution_table)
            rows.push_back(fmt::format("[{}, {}]", number(p.speed), number(p.restitution)));
        out.put("restitution_table", fmt::format("[{}]", fmt::join(rows, ", ")));
    } else {
        out.put("restitution", pair.restitution);
        out.put("restitution_speed", pair.restitution_speed);
    }
    if (!pair.stiffness) out.comment(fmt::format("chosen for: {}", plan.stiffness_reason));
    hertz ? out.put("modulus", plan.modulus) : out.put("stiffness", plan.loading_stiffness);
    if (pair.tangential == TangentialLaw::none) return;
    out.put("friction", pair.friction);
    out.put("rolling_friction", pair.rolling_friction);
    out.put("tangential_ratio", pair.tangential_ratio);
    if (pair.tangential == TangentialLaw::incremental_slip) out.put("gamma", pair.gamma);
    out.put("tangential_damping", pair.tangential_damping);
}

void write_contact(SceneText& out, const Scene& scene, const Plan& plan) {
    const Contact& contact = scene.contact;
    out.table("contact");
    if (contact.rubs())
        out.words("arms", contact.arms == LeverArms::contact_plane ? "contact-plane" : "radius");
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b)
            write_pair(out, scene.between(a, b), plan.between(a, b), scene.species[b].name, scene.species[a]);
        write_pair(out, contact.wall[a], plan.wall[a], "wall", scene.species[a]);
    }
}

void write_container(SceneText& out, const Container& container) {
    out.table("container");
    switch (container.shape) {
        case Container::Shape::wedge:
            out.words("shape", "wedge");
            out.put("half_angle", container.half_angle);
            out.put("slant_height", container.slant_height);
            out.put("half_width", container.half_width);
            break;
        case Container::Shape::box:
            out.words("shape", "box");
            out.put("width", 2 * container.half_width);
            break;
        case Container::Shape::cylinder:
            out.words("shape", "cylinder");
            out.put("diameter", 2 * container.half_width);
            break;
        case Container::Shape::none:
            out.words("shape", "none");
            return;
    }
    if (container.shape != Container::Shape::cylinder) {
        out.put("depth", container.depth);
        out.flag("periodic_depth", container.periodic_depth);
    }
    out.put("height", container.height);
    out.words("top", container.lid ? "lid" : "open");
    out.words("outlet", "closed");
}

void write_exact(SceneText& out, const Scene& scene) {
    for (const FreeWall& wall : scene.walls) {
        out.element("wall");
        out.words("name", wall.name);
        out.put("point", vector(wall.point));
        out.put("normal", vector(wall.normal));
        out.put("velocity", vector(wall.velocity));
        out.flag("moves", wall.moves);
    }
    for (const ListedGrain& grain : scene.start.grains) {
        out.element("grain");
        out.words("species", scene.species[grain.species].name);
        out.put("diameter", grain.diameter);
        out.put("position", vector(grain.position));
        out.put("velocity", vector(grain.velocity));
        out.put("spin", vector(grain.spin));
    }
}

void write_drive(SceneText& out, const Scene& scene) {
    const Drive& drive = scene.drive;
    if (!drive.present) return;
    out.table("drive");
    out.put("frequency", drive.frequency);
    out.comment(fmt::format("g level {:.6g}", drive.g_level(scene.gravity.norm())));
    out.put("amplitude", drive.amplitude);
    out.put("direction", vector(drive.direction));
    out.put("phase", phase(drive.phase));
    out.put("ramp", drive.ramp);
    out.words("moves", drive.moves == Drive::Moves::container ? "container" : "floor");
}

void write_run(SceneText& out, const Scene& scene, const Plan& plan) {
    const Start& start = scene.start;
    out.table("start");
    if (start.method == Start::Method::grains) {
        out.words("method", "grains");
    } else if (start.method == Start::Method::layers) {
        out.words("method", "layers");
        out.put("settle_limit", start.settle_limit);
        out.put("settle_damping", start.settle_damping);
    } else {
        out.words("method", "file");
        out.words("file", start.file);
        out.flag("keep_clock", start.keep_clock);
    }
    const Run& run = scene.run;
    out.table("run");
    out.put("duration", run.duration);
    out.whole("seed", static_cast<std::int64_t>(run.seed));
    out.whole("threads", run.threads);
    if (!run.step) out.comment(fmt::format("chosen for: {}", plan.step_reason));
    out.put("step", plan.clock.step);
    out.words("accuracy", word_of(run.accuracy, accuracy_words));
    out.put("overlap", run.overlap);
    out.words("integrator", word_of(run.integrator, integrator_words));
    out.words("precision", word_of(run.precision, precision_words));
    out.flag("contact_corrections", run.contact_corrections);

    const Output& output = scene.output;
    out.table("output");
    out.flag("trajectory", output.trajectory);
    if (output.trajectory) {
        out.put("trajectory_interval", static_cast<double>(plan.trajectory_every) * plan.clock.step);
        out.flag("orientation", output.orientation);
    }
    out.put("measures_interval", static_cast<double>(plan.measures_every) * plan.clock.step);
    out.flag("contacts", output.contacts);
}

void write_film_look(SceneText& out, const FilmLook& look) {
    out.words("style", word_of(look.style, style_words));
    // Only what the style does not imply, so that the scene can be given another style.
    const FilmLook implied = FilmLook::of(look.style);
    if (look.occlusion != implied.occlusion) out.flag("occlusion", look.occlusion);
    if (look.shadows != implied.shadows) out.flag("shadows", look.shadows);
    if (look.ground != implied.ground) out.flag("ground", look.ground);
    out.flag("rotation", look.rotation);
}

// After all keys of [film] itself, which would belong to this table below it.
void write_cut(SceneText& out, const FilmCut& cut) {
    if (!cut.present) return;
    out.table("film.cut");
    out.put("normal", vector(cut.normal));
    out.put("at", cut.at);
    if (cut.thickness > 0) out.put("thickness", cut.thickness);
}

void write_camera(SceneText& out, const Camera& camera) {
    const auto place = [&](const char* key, const std::optional<Vec3>& point) {
        if (point) out.put(key, vector(*point));
    };
    out.table("film.camera");
    place("position", camera.position);
    place("target", camera.target);
    if (!camera.position) {
        out.words("frame", word_of(camera.frame, camera_frame_words));
        out.put("reach", camera.reach);
        out.put("azimuth", camera.azimuth);
        out.put("elevation", camera.elevation);
    }
    out.put("field_of_view", camera.field_of_view);
    out.put("zoom", camera.zoom);
    out.flag("follow", camera.follow);
    if (camera.orbit != 0) out.put("orbit", camera.orbit);
    out.put("orbit_time", camera.orbit_time);
    for (const CameraKey& key : camera.keys) {
        out.element("film.camera.key");
        out.put("time", key.time);
        out.put("azimuth", key.azimuth);
        out.put("elevation", key.elevation);
        out.put("zoom", key.zoom);
        place("target", key.target);
    }
}

void write_colour(SceneText& out, const GrainColouring& colour) {
    out.table("film.colour");
    out.words("by", word_of(colour.by, grain_value_words));
    if (colour.by == GrainValue::species) return;
    out.words("map", word_of(colour.map, colour_map_words));
    // Else as the quantity has it, also when a finished run is drawn again in other colours.
    if (colour.fixed)
        out.put("range", fmt::format("[{}, {}]", number(colour.range[0]), number(colour.range[1])));
    if (!colour.unit.empty()) out.words("unit", colour.unit);
    if (colour.by == GrainValue::start_height) out.whole("layers", colour.layers);
}

std::string ids(const std::vector<std::int32_t>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string names(const std::vector<std::size_t>& chosen, const std::vector<Species>& species) {
    std::vector<std::string> words;
    for (const std::size_t s : chosen) words.push_back(quoted(species[s].name));
    return fmt::format("[{}]", fmt::join(words, ", "));
}

void write_marks(SceneText& out, const FilmShows& look, const std::vector<Species>& species) {
    for (const FilmPlot& plot : look.plots) {
        out.element("film.plot");
        out.words("y", plot.column);
        out.words("label", plot.label);
        if (plot.range)
            out.put("range", fmt::format("[{}, {}]", number((*plot.range)[0]), number((*plot.range)[1])));
    }
    if (look.arrows.across > 0) {
        out.table("film.arrows");
        out.whole("grid", look.arrows.across);
        out.words("of", look.arrows.period ? "period" : "now");
        out.put("speed", look.arrows.speed);
    }
    if (look.trails.wanted()) {
        out.table("film.trails");
        if (!look.trails.species.empty()) out.put("species", names(look.trails.species, species));
        if (!look.trails.grains.empty()) out.put("grains", ids(look.trails.grains));
        out.put("duration", look.trails.duration);
    }
}

void write_film(SceneText& out, const Film& film, const std::vector<Species>& species) {
    out.table("film");
    out.put("size", fmt::format("[{}, {}]", film.width, film.height));
    out.put("rate", film.rate);
    out.words("title", film.title);
    if (film.periods > 0) out.whole("periods", film.periods);
    if (!film.shows.text.empty()) out.words("text", film.shows.text);
    out.whole("quality", film.quality);
    out.words("preset", film.preset);
    if (!film.purpose.empty()) out.words("for", film.purpose);
    out.words("format", word_of(film.format, film_format_words));
    out.flag("transparent", film.transparent);
    out.words("max_size", film.max_size ? fmt::format("{} B", *film.max_size) : "none");
    if (film.sheet[0] > 0) out.put("sheet", fmt::format("[{}, {}]", film.sheet[0], film.sheet[1]));
    if (!(film.background == default_background(film.look.style)))
        out.words("background", colour_text(film.background));
    out.words("words", word_of(film.words, word_place_words));
    // Else as the camera moves, also when a finished run is drawn again with another camera.
    if (film.axes != film.camera.moves()) out.flag("axes", film.axes);
    out.flag("wall_ghost", film.wall_ghost);
    out.put("exaggerate", film.exaggerate);
    write_film_look(out, film.look);
    if (!film.shows.hidden.empty()) out.put("hide", names(film.shows.hidden, species));
    if (!film.shows.ghosts.empty()) out.put("ghost", names(film.shows.ghosts, species));
    if (!film.shows.highlighted.empty()) out.put("highlight", ids(film.shows.highlighted));
    if (film.shows.highlight_if.wanted()) out.words("highlight_if", film.shows.highlight_if.text);
    out.flag("force_chains", film.shows.force_chains);
    write_cut(out, film.look.cut);
    write_colour(out, film.shows.colour);
    write_marks(out, film.shows, species);
    write_camera(out, film.camera);
    for (const FilmSegment& segment : film.segments) {
        out.element("film.segment");
        const bool motion = segment.kind == FilmSegment::Kind::motion;
        out.words("kind", motion ? "motion" : "locked");
        out.put("duration", segment.duration);
        if (motion) {
            out.put("playback", segment.playback);
        } else {
            out.whole("every", segment.every);
            out.put("phase", phase(segment.phase));
        }
        if (segment.average > 0) out.whole("average", segment.average);
        if (segment.exposure > 0) {
            out.put("exposure", segment.exposure);
            out.whole("exposures", segment.exposures);
        }
    }
}

}  // namespace

std::string resolved_scene(const Scene& scene, const Plan& plan) {
    SceneText out;
    out.comment("Every value as it was used, in SI units; phases in turns, the camera in degrees.");
    out.words("title", scene.title);
    out.put("gravity", vector(scene.gravity));
    for (const Species& species : scene.species) write_species(out, species, !scene.start.grains.empty());
    write_contact(out, scene, plan);
    write_container(out, scene.container);
    write_exact(out, scene);
    write_drive(out, scene);
    write_run(out, scene, plan);
    write_film(out, scene.film, scene.species);
    return out.take();
}

}  // namespace grainreel
