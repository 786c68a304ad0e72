// Parses a VTK file in XML into a tree of elements with the places of their texts. The texts stay in the
// file's bytes.
#pragma once

#include <cstdint>
#include <list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/files/foreign/bytes/content.hpp"

namespace grainreel {

struct XmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::int64_t line = 0;
    std::uint64_t begin = 0, end = 0;  // place of its text before its first child
    std::list<XmlElement> children;    // a list, which needs no second copy to grow

    // The value of an attribute; empty where there is none.
    std::string_view attribute(std::string_view name) const;
    bool has(std::string_view name) const;
    // The first child with that name; null where there is none.
    const XmlElement* child(std::string_view name) const;
};

struct XmlTree {
    XmlElement root;
    std::vector<std::string> comments;  // the first few of them
    // The bytes of the file after the "_" of AppendedData; both are equal where there are none.
    std::uint64_t appended_begin = 0, appended_end = 0;
    bool appended_base64 = false;
    bool cut_off = false;  // the file ends before its last element is closed
};

// Raw appended data are not XML, so only the part before them is parsed. Throws UserError with the line where
// the XML is damaged, and where its elements would take more memory than any file of VTK needs.
// may_end_early: a file that ends within an element is used as far as it goes.
XmlTree xml_tree(const Content& content, bool may_end_early = false);

// The attribute `type` of VTKFile near the beginning of a file, "PolyData"; "unknown" where VTKFile has none,
// empty where the file is no VTK file.
std::string vtk_file_type(std::string_view head);

}  // namespace grainreel
