// The library's functions for scenes: reads and plans them.
#include "engine/library/internal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <utility>

#include "engine/base/lists.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel::v1 {
namespace {

Scene scene_from(const NamedText& from, const std::vector<std::string>& settings) {
    auto impl = std::make_shared<Scene::Impl>();
    impl->text = from.text;
    impl->file = from.file;
    impl->settings = settings;
    impl->scene = read_scene_text(from.text, from.file, Assignments(settings), measurable_in);
    impl->plan = make_plan(impl->scene);
    return Scene(std::move(impl));
}

std::size_t place_of_species(const grainreel::Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const Species& one : scene.species) names.push_back(one.name);
    if (const auto place = place_in(names, name)) return *place;
    throw Error(fmt::format("contact: '{}' is no species; there are {}", name, fmt::join(names, ", ")));
}

}  // namespace

void check_threads(int threads) {
    const double most = find_key("run.threads")->range.high;
    if (threads < 0 || threads > most)
        throw Error(fmt::format("threads: must be from 0 to {}, but is {}", most, threads));
}

Scene::Scene(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Scene Scene::from_file(const std::filesystem::path& file, const std::vector<std::string>& settings) {
    return told([&] { return scene_from(text_of_scene(file), settings); });
}

Scene Scene::from_text(std::string_view text, const std::filesystem::path& file,
                       const std::vector<std::string>& settings) {
    return told([&] { return scene_from({std::string(text), file}, settings); });
}

std::string Scene::name() const {
    return impl_->scene.name;
}
std::string Scene::title() const {
    return impl_->scene.title;
}
std::vector<std::string> Scene::species() const {
    std::vector<std::string> names;
    for (const Species& one : impl_->scene.species) names.push_back(one.name);
    return names;
}
std::int64_t Scene::grains() const {
    return impl_->scene.grains();
}
double Scene::duration() const {
    return impl_->scene.run.duration;
}
double Scene::step() const {
    return impl_->plan.clock.step;
}
std::int64_t Scene::steps() const {
    return impl_->plan.steps;
}
double Scene::period() const {
    const Drive& drive = impl_->scene.drive;
    return drive.present && drive.frequency > 0 ? 1 / drive.frequency : 0;
}
std::vector<std::string> Scene::walls() const {
    std::vector<std::string> names;
    for (const Face& face : faces_of(impl_->scene)) names.push_back(face.name);
    for (const SceneMesh& mesh : impl_->scene.meshes) names.push_back(mesh.name);
    return names;
}
std::vector<std::string> Scene::warnings() const {
    return impl_->plan.warnings;
}
std::string Scene::resolved() const {
    return told([&] { return resolved_scene(impl_->scene, impl_->plan); });
}

ContactNumbers Scene::contact(const std::string& first, const std::string& second) const {
    const std::size_t a = place_of_species(impl_->scene, first);
    const bool wall = second.empty() || second == "wall" || second == "walls";
    const PairPlan& pair =
        wall ? impl_->plan.wall[a] : impl_->plan.between(a, place_of_species(impl_->scene, second));
    return {pair.loading_stiffness, pair.restitution, pair.friction, pair.effective_mass, pair.contact_time};
}

}  // namespace grainreel::v1
