#include "engine/scene/text/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/scene/text/reader_parts.hpp"
#include "engine/scene/text/scene_file.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

// It is the film's title and its folder's name when the scene has no other.
void check_name(const std::filesystem::path& file) {
    const std::string wrong = complaint_of_utf8(file.filename().string());
    if (!wrong.empty()) throw UserError(fmt::format("{}; rename the file", wrong));
}

void read_gravity(Document& document, Scene& scene) {
    if (document.is_array("gravity")) {
        scene.gravity = *document.vector("gravity");
    } else if (const auto downwards = document.quantity("gravity")) {
        scene.gravity = Vec3(0, 0, *downwards == 0 ? 0 : -*downwards);
    }
}

// Corrections need a spring of constant slopes, and the velocities of velocity Verlet.
bool correctable(const Contact& contact, Integrator integrator) {
    const auto constant = [](const PairContact& pair) {
        return pair.normal == NormalLaw::walton_braun && !pair.restitution_speed &&
               pair.restitution_table.empty();
    };
    return integrator == Integrator::velocity_verlet &&
           (std::any_of(contact.grain.begin(), contact.grain.end(), constant) ||
            std::any_of(contact.wall.begin(), contact.wall.end(), constant));
}

void read_run(Document& document, Scene& scene) {
    Run& run = scene.run;
    run.duration = document.quantity("run.duration").value_or(run.duration);
    run.seed = static_cast<std::uint64_t>(document.integer("run.seed").value_or(1));
    run.threads = static_cast<int>(document.integer("run.threads").value_or(run.threads));
    run.step = document.quantity("run.step");
    run.accuracy = chosen<Accuracy>(document, "run.accuracy", accuracy_words, Accuracy::standard);
    if (run.accuracy == Accuracy::draft) run.overlap = 0.02;
    if (run.accuracy == Accuracy::reference) run.overlap = 0.003;
    run.overlap = document.quantity("run.overlap").value_or(run.overlap);
    if (const auto steps = document.integer("run.steps_per_contact"))
        run.steps_per_contact = static_cast<int>(*steps);
    run.integrator =
        chosen<Integrator>(document, "run.integrator", integrator_words, Integrator::velocity_verlet);
    run.precision = chosen<Precision>(document, "run.precision", precision_words, Precision::full);
    const auto corrections = document.flag("run.contact_corrections");
    const bool possible = correctable(scene.contact, run.integrator);
    if (corrections.value_or(false) && !possible)
        document.fail(
            "run.contact_corrections",
            "is made for velocity-verlet and the law walton-braun with a restitution that is the same at "
            "any speed; remove it");
    run.contact_corrections = corrections.value_or(possible && run.accuracy != Accuracy::draft);
    if (run.step) document.refuse("run.steps_per_contact", "'step' is given");
}

void read_output(Document& document, Scene& scene) {
    Output& output = scene.output;
    output.trajectory = document.flag("output.trajectory").value_or(output.trajectory);
    if (!output.trajectory) {
        document.refuse("output.trajectory_interval", "no trajectory is kept");
        document.refuse("output.orientation", "no trajectory is kept");
    }
    output.trajectory_interval = document.quantity("output.trajectory_interval");
    output.measures_interval = document.quantity("output.measures_interval");
    output.orientation = document.flag("output.orientation").value_or(output.orientation);
    output.contacts = document.flag("output.contacts").value_or(output.contacts);
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Assignments& sets) {
    return read_scene_text(load_scene_file(file), file, sets);
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets) {
    check_name(file);
    Document document(text, file.string());
    for (const Assignment& assignment : sets) document.set(assignment);
    document.check_keys();

    Scene scene;
    scene.name = file.stem().string();
    scene.file = file.string();
    scene.written = document.written();
    scene.title = document.text("title").value_or(scene.name);
    read_gravity(document, scene);
    read_species(document, scene);
    read_contact(document, scene);
    read_container(document, scene);
    read_exact(document, scene);
    read_drive(document, scene);
    read_start(document, scene);
    read_run(document, scene);
    read_output(document, scene);
    read_film(document, scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    return scene;
}

}  // namespace grainreel
