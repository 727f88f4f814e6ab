// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <core/frame_path.hpp>
#include <core/image_io.hpp>
#include <view/programs.hpp>
#include <view/recorder.hpp>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace brume::view {
namespace {

constexpr const char* kDoing = "recording";

bool isFilmName(const std::string& extension) {
    return extension == ".mp4" || extension == ".mkv" || extension == ".webm";
}

/// A pipe whose reader is gone is an error of write(), not the end of the program.
class IgnorePipeSignal {
  public:
    IgnorePipeSignal() : mBefore(std::signal(SIGPIPE, SIG_IGN)) {}
    ~IgnorePipeSignal() { std::signal(SIGPIPE, mBefore); }

  private:
    void (*mBefore)(int);
};

bool writeAll(int pipe, const std::vector<unsigned char>& bytes) {
    const IgnorePipeSignal ignored;
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t count = ::write(pipe, bytes.data() + at, bytes.size() - at);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        at += static_cast<std::size_t>(count);
    }
    return true;
}

}  // namespace

bool hasFfmpeg() { return hasProgram("ffmpeg"); }

Recorder::Recorder(std::filesystem::path file, double frameRate)
    : mFile(std::move(file)), mFrameRate(frameRate) {
    const std::string extension = mFile.extension().string();
    mIsFilm = isFilmName(extension);
    if (!mIsFilm && extension != ".png" && extension != ".exr")
        throw inputError(kDoing, mFile.string(),
                         "unknown kind of file, allowed are .png, .exr, .mp4, .mkv and .webm");
    if (mIsFilm && !hasFfmpeg())
        throw failure(kDoing, mFile.string(),
                      "ffmpeg is not installed; record .png or .exr instead");
    std::error_code error;
    if (mFile.has_parent_path()) std::filesystem::create_directories(mFile.parent_path(), error);
    if (error) throw failure(kDoing, mFile.parent_path().string(), error.message());
}

Recorder::~Recorder() {
    if (mProcess < 0) return;
    ::kill(mProcess, SIGTERM);
    waitForFilm();
    std::error_code ignored;
    std::filesystem::remove(mFile, ignored);
}

void Recorder::startFilm(const Image& image) {
    mWidth = image.width;
    mHeight = image.height;
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw failure(kDoing, mFile.string(), std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    std::vector<std::string> words = {
        "ffmpeg",    "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
        fmt::format("{}x{}", mWidth, mHeight), "-r", fmt::format("{}", mFrameRate), "-i", "-",
        // Most players want even sizes and this format.
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", mFile.string()};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int error =
        ::posix_spawnp(&mProcess, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    mPipe = ends[1];
    if (error == 0) return;
    ::close(mPipe);
    mProcess = -1;
    throw failure(kDoing, mFile.string(), fmt::format("ffmpeg: {}", std::strerror(error)));
}

int Recorder::waitForFilm() {
    ::close(mPipe);
    int status = 0;
    while (::waitpid(mProcess, &status, 0) < 0 && errno == EINTR) {}
    mProcess = -1;
    return status;
}

void Recorder::add(const Image& image, int frame) {
    if (!mIsFilm) {
        writeImage(makeFramePath(mFile, frame), image);
        ++mCount;
        return;
    }
    if (mProcess < 0) startFilm(image);
    if (image.width != mWidth || image.height != mHeight)
        throw failure(kDoing, mFile.string(), "the pictures changed their size");
    if (!writeAll(mPipe, encodeSrgb8(image)))
        throw failure(kDoing, mFile.string(), "ffmpeg stopped early");
    ++mCount;
}

void Recorder::finish() {
    if (mProcess < 0) return;
    const int status = waitForFilm();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    throw failure(kDoing, mFile.string(), "ffmpeg failed");
}

}  // namespace brume::view
