// A disk of a few hundred kilobytes, for tests that fill it.
#pragma once

#include <sched.h>
#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace grainreel::test {

class SmallDisk {
  public:
    // Lays the disk over an existing folder. This process and those that it starts see it.
    SmallDisk(const std::filesystem::path& folder, std::size_t bytes) : folder_(folder) {
        mounted_ =
            ::unshare(CLONE_NEWNS) == 0 &&
            ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
            ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, ("size=" + std::to_string(bytes)).c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }  // false where mounting is not allowed

  private:
    std::filesystem::path folder_;
    bool mounted_ = false;
};

}  // namespace grainreel::test
