// Runs of other programs: files, series, folders and patterns that some reader of engine/files/foreign takes.
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

namespace {

bool takes(const FileHead& head) {
    return is_foreign(head.path);
}

std::unique_ptr<FrameArchive> open(const std::filesystem::path& path, const FrameRequest& request) {
    return std::make_unique<ForeignArchive>(path, request.reading);
}

}  // namespace

FrameReader foreign_reader() {
    return {"foreign",
            "files of other programs: LAMMPS, LIGGGHTS, MercuryDPM, YADE, Lethe, VTK, XYZ, GSD, AMBER, CSV",
            takes, open};
}

}  // namespace grainreel
