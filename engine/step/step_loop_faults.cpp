// What ends a run within the step loop. Threads note it, and go on to the end of the next step.
#include <fmt/format.h>

#include <tuple>

#include "engine/base/error.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

std::string text_of(const MeshFault& fault, const Clock& clock, const std::string& mesh) {
    const Vec3& x = fault.position;
    const std::string where =
        fmt::format("step {} ({:.6g} s): grain {} at ({:.4g}, {:.4g}, {:.4g}) m", fault.step,
                    clock.time(fault.step), fault.grain, x.x(), x.y(), x.z());
    if (fault.kind == MeshFault::Kind::many_patches)
        return fmt::format(
            "{} touches the mesh {} at more than {} places at once; take larger grains or a mesh without "
            "such "
            "fine folds",
            where, mesh, kMostPatches);
    return fmt::format(
        "{} went through the mesh {} (its centre came to triangle {}); take a smaller run.step or a larger "
        "contact.wall.stiffness",
        where, mesh, fault.triangle);
}

}  // namespace

// Histories hold the number of a triangle as one of their own numbers.
void StepLoop::check_meshes() const {
    constexpr std::int32_t kMostInFloats = 1 << 24;
    GRAINREEL_CHECK(rules_.group_of_mesh.size() >=
                    around_.meshes.size() * static_cast<std::size_t>(rules_.species));
    for (std::size_t m = 0; m < around_.meshes.size(); ++m) {
        const std::int32_t triangles = around_.meshes[m].surface->size();
        for (std::int32_t s = 0; s < rules_.species && triangles > kMostInFloats; ++s)
            if (rules_.groups[rules_.group_of(static_cast<std::int32_t>(m), s)].number_size() ==
                sizeof(float))
                throw UserError(
                    fmt::format("the mesh {} has {} triangles, and with run.precision = \"mixed\" a mesh may "
                                "have at most {}; "
                                "take run.precision = \"full\" or a coarser mesh",
                                around_.meshes[m].name, triangles, kMostInFloats));
    }
}

// The earliest fault, whatever the threads; of one step that of the grain with the lowest id.
void StepLoop::end_with_fault() const {
    const MeshFault* first = nullptr;
    for (int m = 0; m < team_.size(); ++m) {
        const auto& fault = lists_.contacts(m).fault;
        if (fault && (!first || std::tie(fault->step, fault->grain) < std::tie(first->step, first->grain)))
            first = &*fault;
    }
    if (first) throw RunError(text_of(*first, clock_, around_.meshes[first->mesh].name));
}

}  // namespace grainreel
