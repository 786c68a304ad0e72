#include "engine/files/foreign/vtk/xml_tree.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_depth = 64, most_comments = 16, most_of_a_comment = 1000;
constexpr std::size_t bytes_at_once = std::size_t{1} << 20;
constexpr std::string_view appended_tag = "<AppendedData", appended_close = "</AppendedData>";

struct FreeParser {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using Parser = std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser>;

// The place of the present event in the text. Expat 2.9 has other names for these functions, which give 64
// bits on every system.
std::int64_t line_of(XML_Parser parser) {
#if XML_MAJOR_VERSION * 100 + XML_MINOR_VERSION >= 209
    return static_cast<std::int64_t>(XML_GetCurrentLineNumber64(parser));
#else
    return static_cast<std::int64_t>(XML_GetCurrentLineNumber(parser));
#endif
}
std::size_t byte_of(XML_Parser parser) {
#if XML_MAJOR_VERSION * 100 + XML_MINOR_VERSION >= 209
    return static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser));
#else
    return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser));
#endif
}
std::size_t bytes_of(XML_Parser parser) {
#if XML_MAJOR_VERSION * 100 + XML_MINOR_VERSION >= 209
    return static_cast<std::size_t>(XML_GetCurrentByteCount64(parser));
#else
    return static_cast<std::size_t>(XML_GetCurrentByteCount(parser));
#endif
}

// Makes the tree from the events of expat.
class Builder {
  public:
    Builder() : parser_(XML_ParserCreate(nullptr)) {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), &Builder::on_start, &Builder::on_end);
        XML_SetCommentHandler(parser_.get(), &Builder::on_comment);
        XML_SetStartDoctypeDeclHandler(parser_.get(), &Builder::on_doctype);
    }

    bool feed(std::string_view bytes, bool last) {
        while (bytes.size() > bytes_at_once) {
            if (!parse(bytes.substr(0, bytes_at_once), false)) return false;
            bytes.remove_prefix(bytes_at_once);
        }
        return parse(bytes, last);
    }
    std::int64_t line() const { return line_of(parser_.get()); }
    bool at_end_of_file() const {
        const XML_Error error = XML_GetErrorCode(parser_.get());
        return error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN ||
               error == XML_ERROR_PARTIAL_CHAR;
    }
    std::string complaint() const {
        if (!complaint_.empty()) return complaint_;
        if (at_end_of_file())
            return "the file ends before its last element is closed; it is cut off: write it again";
        return fmt::format("is no valid XML: {}; {}", XML_ErrorString(XML_GetErrorCode(parser_.get())),
                           kWriteAgain);
    }
    bool refused() const { return !complaint_.empty(); }

    std::vector<XmlElement> top;
    std::vector<std::string> comments;

  private:
    bool parse(std::string_view bytes, bool last) {
        return XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()), last) == XML_STATUS_OK;
    }
    std::size_t byte() const { return byte_of(parser_.get()); }

    void stop(std::string why) {
        complaint_ = std::move(why);
        XML_StopParser(parser_.get(), XML_FALSE);
    }

    // The innermost open element.
    XmlElement* innermost() { return open_.empty() ? nullptr : open_.back(); }
    void end_text() {
        if (XmlElement* element = innermost(); element != nullptr && !ended_) element->end = byte();
        ended_ = true;
    }

    void start(const char* name, const char** attributes) {
        end_text();
        if (open_.size() >= most_depth)
            return stop("has elements within elements without an end; it is no file of VTK");
        XmlElement* parent = innermost();
        std::vector<XmlElement>& among = parent == nullptr ? top : parent->children;
        XmlElement& element = among.emplace_back();
        element.name = name;
        for (; attributes[0] != nullptr; attributes += 2)
            element.attributes.emplace_back(attributes[0], attributes[1]);
        element.line = line();
        element.begin = element.end = byte() + bytes_of(parser_.get());
        open_.push_back(&element);
        ended_ = false;
    }
    void end() {
        end_text();
        XmlElement* element = innermost();
        element->end = std::max(element->end, element->begin);
        open_.pop_back();
    }

    static Builder& of(void* data) { return *static_cast<Builder*>(data); }
    static void on_start(void* data, const char* name, const char** attributes) {
        of(data).start(name, attributes);
    }
    static void on_end(void* data, const char*) { of(data).end(); }
    static void on_comment(void* data, const char* text) {
        std::vector<std::string>& comments = of(data).comments;
        if (comments.size() < most_comments)
            comments.push_back(std::string(text).substr(0, most_of_a_comment));
    }
    static void on_doctype(void* data, const char*, const char*, const char*, int) {
        of(data).stop("has a document type of its own, which is not read; remove the DOCTYPE");
    }

    Parser parser_;
    std::vector<XmlElement*> open_;  // open elements; each is the last child of the one before it
    bool ended_ = true;              // the text of the innermost one has ended
    std::string complaint_;
};

// The end of the XML in the file: after the opening tag of AppendedData, or the end of the file.
std::size_t end_of_xml(std::string_view bytes) {
    const std::size_t tag = bytes.find(appended_tag);
    if (tag == std::string_view::npos) return bytes.size();
    const std::size_t close = bytes.find('>', tag);
    return close == std::string_view::npos ? bytes.size() : close + 1;
}

void find_appended(const fs::path& file, std::string_view bytes, std::size_t from, XmlTree& tree) {
    const XmlElement* element = tree.root.child("AppendedData");
    if (element == nullptr) return;
    const std::string_view encoding = element->attribute("encoding");
    tree.appended_base64 = encoding == "base64" || encoding.empty();
    if (!tree.appended_base64 && encoding != "raw")
        refuse_vtk_line(file, element->line,
                        fmt::format("appended data in \"{}\", which is not read; write them raw or as base64",
                                    encoding.substr(0, 40)));
    while (from < bytes.size() && bytes[from] != '_') {
        if (std::string_view(" \t\r\n").find(bytes[from]) == std::string_view::npos) return;
        ++from;
    }
    if (from == bytes.size()) return;
    tree.appended_begin = from + 1;
    const std::size_t close = bytes.rfind(appended_close);
    tree.appended_end = close == std::string_view::npos || close < from + 1 ? bytes.size() : close;
}

}  // namespace

std::string_view XmlElement::attribute(std::string_view wanted) const {
    for (const auto& [key, value] : attributes)
        if (key == wanted) return value;
    return {};
}

bool XmlElement::has(std::string_view wanted) const {
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const auto& each) { return each.first == wanted; });
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
    for (const XmlElement& element : children)
        if (element.name == wanted) return &element;
    return nullptr;
}

XmlTree xml_tree(const fs::path& file, std::string_view bytes, bool may_end_early) {
    const std::size_t end = end_of_xml(bytes);
    const bool appended = end < bytes.size();
    const bool empty_tag = appended && end >= 2 && bytes[end - 2] == '/';
    Builder builder;
    XmlTree tree;
    bool good = builder.feed(bytes.substr(0, end), !appended);
    if (good && appended) good = builder.feed(empty_tag ? "</VTKFile>" : "</AppendedData></VTKFile>", true);
    if (!good) {
        tree.cut_off = !builder.refused() && builder.at_end_of_file();
        if (!tree.cut_off || !may_end_early || builder.top.empty())
            refuse_vtk_line(file, builder.line(), builder.complaint());
    }
    if (builder.top.empty() || builder.top[0].name != "VTKFile")
        refuse_vtk_line(file, 1, "this XML is no file of VTK: its element VTKFile is missing");
    tree.root = std::move(builder.top[0]);
    tree.comments = std::move(builder.comments);
    if (appended && !empty_tag) find_appended(file, bytes, end, tree);
    return tree;
}

std::string vtk_file_type(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || head[first] != '<') return {};
    const std::size_t tag = head.find("<VTKFile");
    if (tag == std::string_view::npos) return {};
    const std::string_view words = head.substr(tag, head.find('>', tag) - tag);
    std::size_t at = words.find("type");
    // The attribute header_type also ends in "type"; it is passed over.
    while (at != std::string_view::npos && words[at - 1] > ' ') at = words.find("type", at + 1);
    const std::size_t open = at == std::string_view::npos ? at : words.find_first_of("\"'", at);
    if (open == std::string_view::npos) return "unknown";
    return std::string(words.substr(open + 1, words.find(words[open], open + 1) - open - 1));
}

}  // namespace grainreel
