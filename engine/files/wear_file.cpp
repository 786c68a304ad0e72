#include "engine/files/wear_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/state/face_names.hpp"

namespace grainreel {

struct WearReader::Impl {
    Impl(const std::filesystem::path& path, const Scene& scene)
        : name(path.string()), file(NetcdfFile::open(path)) {
        const std::vector<std::string> names = face_names(scene);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            meshes.push_back({names.at(names.size() - scene.meshes.size() + m),
                              static_cast<std::size_t>(scene.meshes[m].surface->size())});
        for (const Mesh& mesh : meshes) check(mesh);
        const std::size_t counted = file.length("time"),
                          records = std::min(counted, file.records_on_disk(counted));
        bounds.resize(2 * records);
        if (records > 0) file.get(file.find_variable("time_bounds"), {0, 0}, {records, 2}, bounds.data());
        if (!std::is_sorted(bounds.begin(), bounds.end()))
            throw UserError(
                fmt::format("{}: is damaged: its records do not follow each other; copy it again", name));
    }

    struct Mesh {
        std::string name;
        std::size_t triangles;
    };

    void check(const Mesh& mesh) const {
        if (!file.has_variable(wear_field(mesh.name)))
            throw UserError(
                fmt::format("{}: has no wear of {}; run the scene with output.instruments = "
                            "[\"wear\"]",
                            name, mesh.name));
        const std::size_t there = file.length("triangle_of_" + mesh.name);
        if (there != mesh.triangles)
            throw UserError(
                fmt::format("{}: has {} triangles of {}, but scene.toml beside it has {}; they are "
                            "of two runs",
                            name, there, mesh.name, mesh.triangles));
    }

    std::vector<double> values(const std::string& field, std::size_t record, std::size_t count) const {
        std::vector<double> all(count);
        if (count > 0) file.get(file.find_variable(field), {record, 0}, {1, count}, all.data());
        return all;
    }

    std::string name;
    NetcdfFile file;
    std::vector<Mesh> meshes;
    std::vector<double> bounds;  // s, begin and end of each record
};

WearReader::WearReader(const std::filesystem::path& path, const Scene& scene)
    : impl_(std::make_unique<Impl>(path, scene)) {}
WearReader::~WearReader() = default;

std::size_t WearReader::records() const {
    return impl_->bounds.size() / 2;
}

std::vector<MeshWear> WearReader::at(double time) const {
    const std::vector<double>& bounds = impl_->bounds;
    std::vector<MeshWear> all(impl_->meshes.size());
    if (records() == 0) return all;
    std::size_t record = 0;
    while (record + 1 < records() && bounds[2 * record + 1] < time) ++record;
    const double begin = bounds[2 * record], end = bounds[2 * record + 1];
    const double share = end > begin ? std::clamp((time - begin) / (end - begin), 0.0, 1.0) : 1;
    for (std::size_t m = 0; m < all.size(); ++m) {
        const auto& [name, triangles] = impl_->meshes[m];
        all[m].pressure = impl_->values(pressure_field(name), record, triangles);
        all[m].wear = impl_->values(wear_field(name), record, triangles);
        if (record == 0) {
            for (double& wear : all[m].wear) wear *= share;
            continue;
        }
        const std::vector<double> before = impl_->values(wear_field(name), record - 1, triangles);
        for (std::size_t t = 0; t < triangles; ++t)
            all[m].wear[t] = before[t] + share * (all[m].wear[t] - before[t]);
    }
    return all;
}

}  // namespace grainreel
