// Small public types: errors, frames, meshes, virtual bases.
#include "engine/library/internal.hpp"

#include <charconv>
#include <limits>

#include "engine/mesh/load_mesh.hpp"
#include "grainreel/contact_law.hpp"

namespace grainreel::v1 {
namespace {

// "12" at the end of `text` behind a colon: the number, and text without both; 0 where there is none.
int number_cut_off(std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon + 1 == text.size()) return 0;
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data() + colon + 1, end, number);
    if (error != std::errc() || stopped != end || number < 1) return 0;
    text.resize(colon);
    return number;
}

}  // namespace

Error::Error(const std::string& message, Kind kind) : std::runtime_error(message), kind_(kind) {
    std::string place = message.substr(0, message.find(": "));
    if (place.size() == message.size()) return;
    const int last = number_cut_off(place);
    const int before = last > 0 ? number_cut_off(place) : 0;
    line_ = before > 0 ? before : last;
    column_ = before > 0 ? last : 0;
    file_ = place;
}

void Frame::add(const Vector& where, double r, std::int32_t kind) {
    id.push_back(id.empty() ? 0 : id.back() + 1);
    species.push_back(kind);
    radius.push_back(r);
    position.push_back(where);
    velocity.emplace_back();
    spin.emplace_back();
    if (!orientation.empty()) orientation.emplace_back();
}

Mesh Mesh::plate(const std::string& name, const Vector& corner, const Vector& first, const Vector& second) {
    const Vec3 at = inside(corner), a = inside(first), b = inside(second);
    return {
        name, {corner, outside(at + a), outside(at + a + b), outside(at + b)}, {{0, 1, 2}, {0, 2, 3}}, false};
}

Mesh Mesh::box(const std::string& name, const Vector& low, const Vector& high) {
    Mesh mesh;
    mesh.name = name;
    mesh.glass = true;
    for (int k = 0; k < 8; ++k)
        mesh.points.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 2, 6}, {0, 6, 4},
                      {1, 5, 7}, {1, 7, 3}, {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6}};
    return mesh;
}

Mesh Mesh::from_file(const std::filesystem::path& file, double scale) {
    const TriangleMesh read = told([&] { return load_mesh(file, {scale}).mesh; });
    Mesh mesh;
    mesh.name = file.stem().string();
    for (const Vec3& point : read.vertices) mesh.points.push_back(outside(point));
    mesh.triangles = read.triangles;
    return mesh;
}

ContactLaw::~ContactLaw() = default;
double ContactLaw::stored_energy(const Touch&, ContactMemory) const {
    return std::numeric_limits<double>::quiet_NaN();
}

FrameSource::~FrameSource() = default;
FrameReader::~FrameReader() = default;

}  // namespace grainreel::v1
