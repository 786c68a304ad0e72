#include "engine/files/frames/writers/hdf5_sink.hpp"

#if __has_include(<H5FDdevelop.h>)  // HDF5 1.14
#include <H5FDdevelop.h>
#endif
#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

namespace grainreel {

namespace {

struct Sink {
    H5FD_t library_part;  // must come first
    int file;
    haddr_t allocated, end;
    bool* failed;
};

Sink& sink_of(H5FD_t* file) {
    return *reinterpret_cast<Sink*>(file);
}

const Sink& sink_of(const H5FD_t* file) {
    return *reinterpret_cast<const Sink*>(file);
}

H5FD_t* open_sink(const char* name, unsigned, hid_t properties, haddr_t) {
    const void* info = H5Pget_driver_info(properties);
    if (info == nullptr) return nullptr;
    const int file = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return nullptr;
    Sink* sink = new Sink{};
    sink->file = file;
    sink->failed = *static_cast<bool* const*>(info);
    return &sink->library_part;
}

herr_t close_sink(H5FD_t* file) {
    Sink* sink = &sink_of(file);
    if (::close(sink->file) != 0) *sink->failed = true;
    delete sink;
    return 0;
}

haddr_t allocated_in(const H5FD_t* file, H5FD_mem_t) {
    return sink_of(file).allocated;
}

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    sink_of(file).allocated = end;
    return 0;
}

haddr_t end_of(const H5FD_t* file, H5FD_mem_t) {
    return sink_of(file).end;
}

// What was not written is 0.
herr_t read_back(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t begin, std::size_t size, void* to) {
    char* bytes = static_cast<char*>(to);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t some =
            ::pread(sink_of(file).file, bytes + done, size - done, static_cast<off_t>(begin + done));
        if (some < 0 && errno == EINTR) continue;
        if (some < 0) return -1;
        if (some == 0) break;
        done += static_cast<std::size_t>(some);
    }
    std::memset(bytes + done, 0, size - done);
    return 0;
}

herr_t write_all(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t begin, std::size_t size, const void* from) {
    Sink& sink = sink_of(file);
    const char* bytes = static_cast<const char*>(from);
    std::size_t done = 0;
    while (done < size && !*sink.failed) {
        const ssize_t some = ::pwrite(sink.file, bytes + done, size - done, static_cast<off_t>(begin + done));
        if (some < 0 && errno == EINTR) continue;
        if (some <= 0)
            *sink.failed = true;
        else
            done += static_cast<std::size_t>(some);
    }
    sink.end = std::max(sink.end, begin + size);
    return 0;
}

herr_t cut_to_allocated(H5FD_t* file, hid_t, hbool_t) {
    Sink& sink = sink_of(file);
    if (sink.end == sink.allocated) return 0;
    if (::ftruncate(sink.file, static_cast<off_t>(sink.allocated)) != 0) *sink.failed = true;
    sink.end = sink.allocated;
    return 0;
}

hid_t driver() {
    static const hid_t id = [] {
        H5FD_class_t one{};
#ifdef H5FD_CLASS_VERSION
        one.version = H5FD_CLASS_VERSION;
        one.value = static_cast<H5FD_class_value_t>(508);  // one of those that nobody has registered
#endif
        one.name = "grainreel";
        one.maxaddr = (haddr_t{1} << 62) - 1;
        one.fc_degree = H5F_CLOSE_WEAK;
        one.fapl_size = sizeof(bool*);
        one.open = open_sink;
        one.close = close_sink;
        one.get_eoa = allocated_in;
        one.set_eoa = allocate;
        one.get_eof = end_of;
        one.read = read_back;
        one.write = write_all;
        one.truncate = cut_to_allocated;
        const H5FD_mem_t single[] = H5FD_FLMAP_SINGLE;
        std::copy(std::begin(single), std::end(single), std::begin(one.fl_map));
        return H5FDregister(&one);
    }();
    return id;
}

}  // namespace

bool write_through_sink(hid_t file_properties, bool& failed) {
    bool* const pointer = &failed;
    return driver() >= 0 && H5Pset_driver(file_properties, driver(), &pointer) >= 0;
}

}  // namespace grainreel
