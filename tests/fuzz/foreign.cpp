// Files of other programs: read as they are, as grains, and as the contacts and walls of a good file.
#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainreel::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_frames = 20;

constexpr std::string_view two_grains = R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z radius vx vy vz
1 1 0.4 0.5 0.5 0.05 0 0 0
2 1 0.5 0.5 0.5 0.05 0 0 1
)";

// A piece by another process, or one step of a series: what lists of files may name.
constexpr std::string_view vtk_piece = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="2"><PointData>
<DataArray type="Float32" Name="radius" format="ascii">0.1 0.1</DataArray>
</PointData><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0</DataArray></Points>
</Piece></PolyData></VTKFile>
)";

template <class Use>
void tolerant(Use use) {
    try {
        use();
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
}

void read_raw(const fs::path& file) {
    const RawFormat* format = raw_format_of(file);
    if (format == nullptr) return;
    const std::unique_ptr<RawFile> opened = format->open(file);
    const std::size_t frames = std::min(opened->moments().size(), most_frames);
    for (std::size_t k = 0; k < frames; ++k) opened->read(k);
    opened->news();
    opened->grow();
}

void read_archive(const fs::path& file, const ReadingOptions& options) {
    const ForeignArchive archive(file, options);
    const std::size_t frames = std::min(archive.moments().size(), most_frames);
    for (std::size_t k = 0; k < frames; ++k) {
        archive.grains(k);
        archive.touches(k);
        for (std::size_t wall = 0; wall < archive.walls().size(); ++wall) archive.wall_cells(k, wall);
    }
    archive.news();
}

void attempt_foreign(std::string_view bytes) {
    static const fs::path good = scratch().write("good.dump", two_grains);
    static const fs::path piece = scratch().write("piece.vtp", vtk_piece);
    const fs::path file = scratch().write("input", bytes);
    ReadingOptions options;
    options.one = true;
    tolerant([&] { read_raw(file); });
    tolerant([&] {
        if (is_foreign(file)) read_archive(file, options);
    });
    options.radius = 1e-3;
    tolerant([&] {
        if (is_foreign(file)) read_archive(file, options);
    });
    options.radius.reset();
    options.contacts = {file.string()};
    tolerant([&] { read_archive(good, options); });
    options.contacts.clear();
    options.walls = {file.string()};
    tolerant([&] { read_archive(good, options); });
}

}  // namespace

Target foreign_target() {
    return {"foreign", "files of other programs", attempt_foreign};
}

}  // namespace grainreel::fuzz
