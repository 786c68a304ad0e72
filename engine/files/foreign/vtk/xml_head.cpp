#include "engine/files/foreign/vtk/xml_head.hpp"

#include "engine/base/error.hpp"
#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {
namespace {

// Whether a Piece was understood.
bool count_piece(const XmlArrays& arrays, const XmlElement& piece, RawMoment& moment) {
    const std::uint64_t points = arrays.count_in(piece, "NumberOfPoints");
    const std::uint64_t vertices = arrays.count_in(piece, "NumberOfVerts");
    const std::uint64_t lines = arrays.count_in(piece, "NumberOfLines");
    const std::uint64_t faces = arrays.count_in(piece, "NumberOfPolys");
    const bool strips = arrays.count_in(piece, "NumberOfStrips") > 0;
    // Lines may have more than two points, and strips and polygons fewer than three.
    if (strips || lines > 0 || (vertices > 0 && vertices != points) || (vertices > 0 && faces > 0))
        return false;
    if (faces > 0)
        moment.has_walls = true;
    else
        moment.grains += static_cast<std::int64_t>(points);
    return true;
}

}  // namespace

bool count_by_head(const VtkPartFile& part_file, bool time_known, VtkParts& parts) {
    const FileHead head = unpacked_head(part_file.file);
    if (vtk_file_type(head.bytes) != "PolyData" || head.bytes.find("<AppendedData") == std::string::npos)
        return false;
    try {
        const XmlTree tree = xml_tree(part_file.file, head.bytes);
        const XmlElement* set = tree.root.child("PolyData");
        if (set == nullptr) return false;
        // A time of its own may stand far behind.
        const bool own_time = set->child("FieldData") != nullptr || tree.root.child("FieldData") != nullptr;
        if (own_time && !time_known) return false;
        const XmlArrays arrays(part_file.file, head.bytes, tree);
        RawMoment moment;
        for (const XmlElement& piece : set->children)
            if (piece.name == "Piece" && !count_piece(arrays, piece, moment)) return false;
        parts.moment.grains += moment.grains;
        parts.moment.has_walls = parts.moment.has_walls || moment.has_walls;
        return true;
    } catch (const UserError&) {
        return false;  // reading it all says what is wrong
    }
}

}  // namespace grainreel
