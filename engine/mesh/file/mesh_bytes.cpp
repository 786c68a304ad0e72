#include "engine/mesh/file/mesh_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view shipped_prefix = "shipped:";
constexpr const char* what_to_give = "give the path of an STL, OBJ or PLY file";

void check_kind(const fs::path& file) {
    std::error_code ignored;
    switch (fs::status(file, ignored).type()) {
        case fs::file_type::regular:
            return;
        case fs::file_type::directory:
            refuse_file(file, fmt::format("this is a folder; {}", what_to_give));
        case fs::file_type::not_found:
            refuse_file(file, fmt::format("there is no such file; {}", what_to_give));
        case fs::file_type::fifo:
            refuse_file(file, "this is a pipe; give the path of an ordinary file");
        case fs::file_type::none:
        case fs::file_type::unknown:
            refuse_file(file, "cannot be read; check its permissions");
        default:
            refuse_file(file, fmt::format("this is a device; {}", what_to_give));
    }
}

struct Open {
    int file;
    ~Open() {
        if (file >= 0) ::close(file);
    }
};

}  // namespace

std::string mesh_bytes(const fs::path& file) {
    if (const auto shipped = shipped_mesh(file)) return std::string(*shipped);
    check_kind(file);
    const Open open{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    struct stat about {};
    if (open.file < 0 || ::fstat(open.file, &about) != 0 || !S_ISREG(about.st_mode))
        refuse_file(file, "cannot be read; check its permissions");
    const auto size = static_cast<std::uint64_t>(about.st_size);
    if (size == 0) refuse_file(file, fmt::format("is empty; {}", what_to_give));
    if (size > largest_mesh_file) refuse_file(file, "is larger than 2 GiB; give a mesh of fewer triangles");
    std::string bytes(size, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(open.file, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) refuse_file(file, "cannot be read; check its permissions");
        if (got == 0) refuse_file(file, "became shorter while it was read; try again when it is whole");
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

bool is_shipped_mesh(const std::filesystem::path& file) {
    return file.filename().string().starts_with(shipped_prefix);
}

std::optional<std::string_view> shipped_mesh(const std::filesystem::path& file) {
    if (!is_shipped_mesh(file)) return std::nullopt;
    const std::string name = file.filename().string().substr(shipped_prefix.size());
    std::vector<std::string> names;
    for (const ShippedMesh& mesh : shipped_meshes()) {
        if (mesh.name == name) return mesh.bytes;
        names.push_back(mesh.name);
    }
    throw UserError(fmt::format("{}{}: the program has no such mesh; it has {}", shipped_prefix,
                                excerpt(name), fmt::join(names, ", ")));
}

}  // namespace grainreel
