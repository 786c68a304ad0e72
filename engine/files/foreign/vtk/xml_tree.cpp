#include "engine/files/foreign/vtk/xml_tree.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>

#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_depth = 64, most_comments = 16, most_of_a_comment = 1000;
constexpr std::uint64_t kTail = 65536;  // bytes at the end in which the end of AppendedData is looked for
constexpr std::uint64_t longest_token = std::uint64_t{8} << 20;  // bytes of a tag or a comment
constexpr std::string_view appended_name = "AppendedData", appended_close = "</AppendedData>";

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
    // most_bytes: memory of the elements.
    explicit Builder(std::uint64_t most_bytes) : parser_(XML_ParserCreate(nullptr)), most_bytes_(most_bytes) {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), &Builder::on_start, &Builder::on_end);
        XML_SetCommentHandler(parser_.get(), &Builder::on_comment);
        XML_SetStartDoctypeDeclHandler(parser_.get(), &Builder::on_doctype);
    }

    // Parses the next bytes; none at the end of the file. False once nothing more is to be parsed.
    bool feed(std::string_view bytes) {
        fed_ += bytes.size();
        const bool good = XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()),
                                    bytes.empty()) == XML_STATUS_OK;
        // A tag or a comment that has not ended yet is kept in memory.
        if (good && fed_ - byte() > longest_token)
            stop("has a tag or a comment of more than 8 MB; it is no file of VTK");
        return good && complaint_.empty();
    }
    // The place behind the opening tag of AppendedData, where parsing ends; 0 without one.
    std::uint64_t appended() const { return appended_; }
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

    std::list<XmlElement> top;
    std::vector<std::string> comments;

  private:
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
        std::list<XmlElement>& among = parent == nullptr ? top : parent->children;
        XmlElement& element = among.emplace_back();
        element.name = name;
        bytes_ += sizeof element + element.name.size();
        for (; attributes[0] != nullptr; attributes += 2) {
            const auto& [key, value] = element.attributes.emplace_back(attributes[0], attributes[1]);
            bytes_ += 2 * sizeof value + key.size() + value.size();
        }
        if (bytes_ > most_bytes_)
            return stop("has more elements than any file of VTK; is this the right file?");
        element.line = line();
        element.begin = element.end = byte() + bytes_of(parser_.get());
        open_.push_back(&element);
        ended_ = false;
        if (element.name != appended_name) return;
        appended_ = element.begin;
        XML_StopParser(parser_.get(), XML_FALSE);
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
    std::uint64_t fed_ = 0, appended_ = 0;
    std::uint64_t bytes_ = 0;  // of the elements in memory
    const std::uint64_t most_bytes_;
};

void find_appended(const Content& content, std::uint64_t from, XmlTree& tree) {
    const XmlElement* element = tree.root.child(appended_name);
    if (element == nullptr) return;
    const std::string_view encoding = element->attribute("encoding");
    tree.appended_base64 = encoding == "base64" || encoding.empty();
    if (!tree.appended_base64 && encoding != "raw")
        refuse_line(content.file(), element->line,
                    fmt::format("appended data in \"{}\", which is not read; write them raw or as base64",
                                encoding.substr(0, 40)));
    const std::uint64_t size = content.size();
    std::string_view piece = content.from(from);
    const std::size_t blanks = piece.find_first_not_of(" \t\r\n");
    if (blanks == std::string_view::npos || piece[blanks] != '_') return;
    tree.appended_begin = from + blanks + 1;
    const std::uint64_t last = std::max(tree.appended_begin, size - std::min<std::uint64_t>(size, kTail));
    piece = content.from(last);
    const std::size_t close = piece.rfind(appended_close);
    tree.appended_end = close == std::string_view::npos ? size : last + close;
}

// The most memory that the elements of a file may take. A list of many files has many elements.
std::uint64_t most_memory(const Content& content) {
    constexpr std::uint64_t some = std::uint64_t{24} << 20;
    std::error_code error;
    const std::uintmax_t on_disk = fs::file_size(content.file(), error);
    return some + (error ? 0 : 8 * on_disk);
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

XmlTree xml_tree(const Content& content, bool may_end_early) {
    const fs::path& file = content.file();
    Builder builder(most_memory(content));
    XmlTree tree;
    std::uint64_t place = 0;
    bool good = true, ended = false;
    while (good && !ended) {
        const std::string_view piece = content.from(place).substr(0, Content::kPiece);
        ended = piece.empty();
        place += piece.size();
        good = builder.feed(piece);
    }
    const std::uint64_t appended = builder.refused() ? 0 : builder.appended();
    if (!good && appended == 0) {
        tree.cut_off = !builder.refused() && builder.at_end_of_file();
        if (!tree.cut_off || !may_end_early || builder.top.empty())
            refuse_line(file, builder.line(), builder.complaint());
    }
    if (builder.top.empty() || builder.top.front().name != "VTKFile")
        refuse_line(file, 1, "this XML is no file of VTK: its element VTKFile is missing");
    tree.root = std::move(builder.top.front());
    tree.comments = std::move(builder.comments);
    const bool empty_tag = appended > 1 && content.from(appended - 2, 1).starts_with('/');
    if (appended > 0 && !empty_tag) find_appended(content, appended, tree);
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
