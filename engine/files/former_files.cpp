#include "engine/files/former_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/files/run_names.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Names in the hidden folder: the list of all names in the run, new files until they are in their places, and
// the ends of files.
constexpr const char *kNames = "names", *kNew = "new", *kEnd = ".end";

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw RunError("{}: what the run was cannot be kept: {}", path.string(), why);
}

void check(const std::error_code& error, const fs::path& path) {
    if (error) fail(path, error.message());
}

// An open file that closes itself.
class OpenFile {
  public:
    OpenFile(int file, fs::path path) : file_(file), path_(std::move(path)) {
        if (file_ < 0) fail(path_, std::strerror(errno));
    }
    ~OpenFile() { ::close(file_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    void read(void* to, std::size_t bytes, std::uintmax_t at) const {
        if (::pread(file_, to, bytes, static_cast<off_t>(at)) != static_cast<ssize_t>(bytes))
            fail(path_, "it ends too early");
    }
    void write(const void* from, std::size_t bytes, std::uintmax_t at) const {
        if (::pwrite(file_, from, bytes, static_cast<off_t>(at)) != static_cast<ssize_t>(bytes))
            fail(path_, std::strerror(errno));
    }
    void cut(std::uintmax_t bytes) const {
        if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail(path_, std::strerror(errno));
    }

  private:
    int file_;
    fs::path path_;
};

int open_to_read(const fs::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
}

void copy_bytes(const OpenFile& from, std::uintmax_t begin, std::uintmax_t end, const OpenFile& to,
                std::uintmax_t at) {
    std::vector<char> part(1 << 20);
    while (begin < end) {
        const auto bytes = static_cast<std::size_t>(std::min<std::uintmax_t>(part.size(), end - begin));
        from.read(part.data(), bytes, begin);
        to.write(part.data(), bytes, at);
        begin += bytes, at += bytes;
    }
}

// A file with a kept end begins with this. `bytes` is how many bytes of the growing file stay. `first` are
// the first bytes of that file: in a NetCDF file they hold the number of records, which changes.
struct EndHead {
    std::uint64_t bytes = 0;
    std::array<char, 16> first{};
};

void keep_end(const fs::path& file, std::uintmax_t bytes, std::uintmax_t size, const fs::path& end) {
    const OpenFile from(open_to_read(file), file), to(make_plain(end), end);
    EndHead head;
    head.bytes = bytes;
    from.read(head.first.data(), std::min<std::uintmax_t>(head.first.size(), size), 0);
    to.write(&head, sizeof head, 0);
    copy_bytes(from, bytes, size, to, sizeof head);
}

void put_end_back(const fs::path& end, const fs::path& file) {
    const std::uintmax_t size = fs::file_size(end);
    const OpenFile from(open_to_read(end), end), to(open_plain(file), file);
    EndHead head;
    from.read(&head, sizeof head, 0);
    to.cut(head.bytes);
    copy_bytes(from, sizeof head, size, to, head.bytes);
    const std::uintmax_t whole = head.bytes + size - sizeof head;
    to.write(head.first.data(), std::min<std::uintmax_t>(head.first.size(), whole), 0);
}

// run.json is small and may be written over when the disk is full, so it is copied.
void give_second_name(const fs::path& file, const fs::path& name) {
    std::error_code error;
    if (file.filename() != "run.json") {
        fs::create_hard_link(file, name, error);
        if (!error) return;
    }
    fs::copy_file(file, name, error);
    check(error, name);
}

bool is_own_folder(const fs::path& path) {
    return other_than_file(path, false) == "a folder";
}

// also/ is left out. It is written when a run ends, and by then the run has passed its former end.
bool is_kept_folder(const fs::path& name) {
    return is_folder_of_runs(name) && name != kFormerRun && name != kFormerRunPart && name != kAlsoFolder;
}

std::vector<fs::path> names_in(const fs::path& folder) {
    std::vector<fs::path> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        names.push_back(entry.path().filename());
    check(error, folder);
    return names;
}

// The run's files and those in its folders, as paths relative to the run.
std::vector<fs::path> files_of(const fs::path& run) {
    std::vector<fs::path> files;
    for (const fs::path& name : names_in(run)) {
        if (is_file_of_runs(name)) files.push_back(name);
        if (!is_kept_folder(name) || !is_own_folder(run / name)) continue;
        for (const fs::path& inside : names_in(run / name)) files.push_back(name / inside);
    }
    return files;
}

bool stays(const fs::path& name) {
    return name == ".lock" || name == "log.txt";
}

void remove_new_files(const fs::path& run) {
    std::ifstream list = read_plain(run / kFormerRun / kNames);
    if (!list) return;
    std::set<std::string> names;
    for (std::string name; std::getline(list, name);) names.insert(name);
    std::error_code ignored;
    for (const fs::path& file : files_of(run))
        if (!stays(file) && names.count(file.string()) == 0 && file.string().find('\n') == std::string::npos)
            fs::remove(run / file, ignored);
}

}  // namespace

FormerFiles::FormerFiles(fs::path run) : run_(std::move(run)), part_(run_ / kFormerRunPart) {
    std::error_code error;
    fs::remove_all(part_, error);
    fs::create_directories(part_ / kNew, error);
    check(error, part_);
}

FormerFiles::~FormerFiles() {
    std::error_code ignored;
    fs::remove_all(part_, ignored);
}

fs::path FormerFiles::new_file(const std::string& name) {
    new_files_.push_back(name);
    return part_ / kNew / name;
}

void FormerFiles::begin() {
    const std::string names = keep_whole();
    for (const Cut& cut : cuts_) keep_growing(cut);
    for (const std::string& name : new_files_)
        if (is_plain(run_ / name) && !is_plain(part_ / name)) give_second_name(run_ / name, part_ / name);
    TextFile(part_ / kNames).write(names);
    std::error_code error;
    fs::rename(part_, run_ / kFormerRun, error);
    check(error, run_ / kFormerRun);
    for (const std::string& name : new_files_) {
        fs::rename(run_ / kFormerRun / kNew / name, run_ / name, error);
        if (!error) continue;
        put_back(run_);
        fail(run_ / name, error.message());
    }
}

void FormerFiles::keep_growing(const Cut& cut) {
    const auto& [name, bytes, records] = cut;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(run_ / name, error);
    check(error, run_ / name);
    if (bytes > size) fail(run_ / name, "it is shorter than it was");
    if (size - bytes <= bytes) return keep_end(run_ / name, bytes, size, part_ / (name + kEnd));
    const fs::path beginning = new_file(name);
    const OpenFile from(open_to_read(run_ / name), run_ / name), to(make_plain(beginning), beginning);
    copy_bytes(from, 0, bytes, to, 0);
    if (records) NetcdfFile::count_records(beginning, *records);
}

// Gives second names to the files that do not grow. Returns the names of all files, one a line.
std::string FormerFiles::keep_whole() const {
    std::string names;
    std::error_code error;
    for (const fs::path& file : files_of(run_)) {
        names += file.string() + "\n";
        if (stays(file) || grows(file)) continue;
        fs::create_directories((part_ / file).parent_path(), error);
        check(error, part_ / file);
        give_second_name(run_ / file, part_ / file);
    }
    return names;
}

// The folder is renamed before it is removed. A removal that is cut short must not look like a kept run.
void FormerFiles::let_go(const fs::path& run) {
    std::error_code ignored;
    fs::remove_all(run / kFormerRunPart, ignored);
    fs::rename(run / kFormerRun, run / kFormerRunPart, ignored);
    fs::remove_all(run / kFormerRunPart, ignored);
}

bool FormerFiles::is_kept(const fs::path& run) {
    return is_own_folder(run / kFormerRun);
}

void FormerFiles::put_back(const fs::path& run) {
    const fs::path kept = run / kFormerRun;
    std::error_code error;
    const auto move_back = [&](const fs::path& name) {
        fs::rename(kept / name, run / name, error);
        check(error, run / name);
    };
    for (const fs::path& name : names_in(kept)) {
        if (is_file_of_runs(name)) move_back(name);
        if (name.extension() == kEnd && grows(name.stem())) {
            put_end_back(kept / name, run / name.stem());
            fs::remove(kept / name, error);
            check(error, kept / name);
        }
        if (!is_kept_folder(name) || !is_own_folder(kept / name)) continue;
        check(make_plain_folder(run / name), run / name);
        for (const fs::path& inside : names_in(kept / name)) move_back(name / inside);
    }
    remove_new_files(run);
    let_go(run);
}

}  // namespace grainreel
