#include "engine/files/foreign/raw_file.hpp"

#include <fmt/format.h>

#include "engine/files/foreign/bytes/byte_source.hpp"

// All formats in the order in which they are asked. NAME stands for a function RawFormat NAME_format(), which
// is in this folder or in a folder below.
#define GRAINREEL_RAW_FORMATS(one)                                                                         \
    one(lammps_binary) one(lammps_text) one(lammps_state) one(vtk_xml) one(vtk_legacy) one(vtk_collection) \
        one(gsd) one(h5md) one(amber) one(mercury_data) one(mercury_contacts) one(mercury_restart)         \
            one(wall_surface) one(xyz) one(number_table)

namespace grainreel {

namespace fs = std::filesystem;

#define GRAINREEL_DECLARE(name) RawFormat name##_format();
GRAINREEL_RAW_FORMATS(GRAINREEL_DECLARE)
#undef GRAINREEL_DECLARE

const RawColumn* RawTable::find(const std::string& name) const {
    for (const RawColumn& column : columns)
        if (column.name == name) return &column;
    return nullptr;
}

const std::vector<RawFormat>& raw_formats() {
#define GRAINREEL_LIST(name) name##_format(),
    static const std::vector<RawFormat> all{GRAINREEL_RAW_FORMATS(GRAINREEL_LIST)};
#undef GRAINREEL_LIST
    return all;
}

const RawFormat* raw_format_of(const fs::path& file) {
    const FileStart head = unpacked_head(file);
    for (const RawFormat& format : raw_formats())
        if (format.takes(head)) return &format;
    return nullptr;
}

}  // namespace grainreel
