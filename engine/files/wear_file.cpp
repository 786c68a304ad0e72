#include "engine/files/wear_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/measure/measures.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

struct WearReader::Impl {
    Impl(const std::filesystem::path& path, const Scene& scene)
        : name(path.string()), file(NetcdfFile::open(path)) {
        const std::vector<std::string> names = face_names(scene);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            meshes.push_back(
                {names.at(names.size() - scene.meshes.size() + m), scene.meshes[m].shape().triangles.size()});
        for (const Mesh& mesh : meshes) check(mesh);
        const std::size_t counted = file.length("time"),
                          records = std::min(counted, file.records_on_disk(counted));
        bounds.resize(2 * records);
        if (records > 0) file.get(file.find_variable("time_bounds"), {0, 0}, {records, 2}, bounds.data());
        if (!std::is_sorted(bounds.begin(), bounds.end()))
            throw UserError("{}: is damaged: its records do not follow each other; copy it again", name);
    }

    struct Mesh {
        std::string name;
        std::size_t triangles;
    };

    void check(const Mesh& mesh) const {
        if (!file.has_variable(wear_field(mesh.name)))
            throw UserError(
                "{}: has no wear of {}; run the scene with output.instruments = "
                "[\"wear\"]",
                name, mesh.name);
        const std::size_t there = file.length("triangle_of_" + mesh.name);
        if (there != mesh.triangles)
            throw UserError(
                "{}: has {} triangles of {}, but scene.toml beside it has {}; they are "
                "of two runs",
                name, there, mesh.name, mesh.triangles);
    }

    std::vector<double> values(const std::string& field, std::size_t record, std::size_t count) const {
        std::vector<double> all(count);
        if (count > 0) file.get(file.find_variable(field), {record, 0}, {1, count}, all.data());
        return all;
    }

    std::string name;
    NetcdfFile file;
    std::vector<Mesh> meshes;
    std::vector<double> bounds;                         // s, the begin and end of each record
    std::shared_ptr<const std::vector<MeshWear>> last;  // the last answer
    std::size_t last_ended = 0;
};

WearReader::WearReader(const std::filesystem::path& path, const Scene& scene)
    : impl_(std::make_unique<Impl>(path, scene)) {}
WearReader::~WearReader() = default;

std::size_t WearReader::records() const {
    return impl_->bounds.size() / 2;
}

std::shared_ptr<const std::vector<MeshWear>> WearReader::until(double time) const {
    const double now = time + 1e-9 * std::abs(time) + 1e-12;
    std::size_t ended = 0;
    while (ended < records() && impl_->bounds[2 * ended + 1] <= now) ++ended;
    if (impl_->last && impl_->last_ended == ended) return impl_->last;
    auto all = std::make_shared<std::vector<MeshWear>>();
    for (const auto& [name, triangles] : impl_->meshes) {
        if (ended == 0)
            all->push_back({std::vector<double>(triangles, kUnknown), std::vector<double>(triangles, 0.0)});
        else
            all->push_back({impl_->values(pressure_field(name), ended - 1, triangles),
                            impl_->values(wear_field(name), ended - 1, triangles)});
    }
    impl_->last = std::move(all);
    impl_->last_ended = ended;
    return impl_->last;
}

}  // namespace grainreel
