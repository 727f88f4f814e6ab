// SPDX-License-Identifier: Apache-2.0
// `brume view` from outside: without a window by script, and in a true one on a virtual screen with
// a keyboard and a mouse.
#include <core/image_io.hpp>

#include "scratch_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace brume::view {
namespace {

namespace fs = std::filesystem;

/// The exit code of a shell command.
int runShell(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

bool hasProgram(const std::string& name) {
    return runShell("command -v " + name + " >/dev/null 2>&1") == 0;
}

/// Of pixels that differ visibly in the left part, where the picture is.
double differingShare(const Image& a, const Image& b, double rightShare = 1) {
    EXPECT_EQ(a.width, b.width);
    const int width = static_cast<int>(a.width * rightShare);
    double count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < width; ++x)
            if (glm::length(a.at(x, y) - b.at(x, y)) > 0.02f) ++count;
    return count / (static_cast<double>(width) * a.height);
}

/// Whether more than one tone is in a part of the picture.
bool isBlank(const Image& image, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            if (glm::length(image.at(x, y) - image.at(x0, y0)) > 0.02f) return false;
    return true;
}

class ViewerTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (mFolder / name).string(); }
    /// `brume view` of the scene under validation; its messages go to the file "log".
    std::string command(const std::string& options) const {
        return std::string(BRUME_EXECUTABLE) + " view " + path("scene.json") +
               " --validate --method sorted --size 480x300 " + options + " >" + path("log") +
               " 2>&1";
    }
    int runScript(const std::string& script) const {
        mFolder.write("script", script);
        return runShell("cd " + path("") + " && timeout 120 " +
                        command("--offscreen --script script"));
    }

    const test::ScratchFolder mFolder;
};

TEST_F(ViewerTest, Script_DrivesTheWindow) {
    ASSERT_EQ(runScript("wait settled\n"
                        "window first.png\n"
                        "key Space\n"  // play
                        "frames 4\n"
                        "key Space\n"
                        "wait settled\n"
                        "window played.png\n"
                        "key M          # the next method\n"
                        "key C          # beside another\n"
                        "wait settled\n"
                        "window split.png\n"
                        "show errors\n"
                        "wait compared\n"
                        "frames 1\n"
                        "window errors.png\n"
                        "press 30 285\n"  // the button to play
                        "mouse 30 285\n"
                        "frames 2\n"
                        "window pressed.png\n"
                        "quit\n"),
              0)
        << mFolder.read("log");
    const Image first = readImage(mFolder / "first.png");
    EXPECT_EQ(first.width, 480);
    EXPECT_FALSE(isBlank(first, 0, 60, 200, 250)) << "no picture";
    EXPECT_FALSE(isBlank(first, 300, 10, 470, 250)) << "no panels";
    const Image played = readImage(mFolder / "played.png");
    EXPECT_GT(differingShare(first, played, 0.45), 0.002);
    const Image split = readImage(mFolder / "split.png"),
                errors = readImage(mFolder / "errors.png");
    EXPECT_GT(differingShare(split, errors, 0.45), 0.3);
    // The button says Pause now.
    const Image pressed = readImage(mFolder / "pressed.png");
    bool isOther = false;
    for (int y = 272; y < 296; ++y)
        for (int x = 8; x < 66; ++x)
            isOther = isOther || glm::length(pressed.at(x, y) - errors.at(x, y)) > 0.2f;
    EXPECT_TRUE(isOther);
}

TEST_F(ViewerTest, WrongScript_IsOneLine) {
    EXPECT_EQ(runScript("wait settled\nfly away\n"), 2);
    const std::string log = mFolder.read("log");
    EXPECT_TRUE(log.starts_with("brume: reading script: script:2: unknown command fly")) << log;
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1);
}

TEST_F(ViewerTest, NoScreen_IsOneLine) {
    EXPECT_EQ(runShell("unset DISPLAY WAYLAND_DISPLAY; timeout 60 " + command("")), 1);
    const std::string log = mFolder.read("log");
    EXPECT_TRUE(log.starts_with("brume: opening a window: ")) << log;
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1);
}

/// A virtual screen; the number is one that is free. Its pixels lie in a file of `folder`.
class Screen {
  public:
    explicit Screen(const fs::path& folder) : mFile(folder / "Xvfb_screen0") {
        int ends[2];
        if (pipe(ends) != 0) return;
        mProcess = fork();
        if (mProcess == 0) {
            const std::string descriptor = std::to_string(ends[1]);
            if (!freopen("/dev/null", "w", stderr)) _exit(126);
            execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "800x600x24",
                   "-nolisten", "tcp", "-fbdir", mFile.parent_path().c_str(), nullptr);
            _exit(127);
        }
        close(ends[1]);
        char text[16] = {};
        for (std::size_t length = 0; length + 1 < sizeof(text);) {
            if (::read(ends[0], text + length, 1) != 1 || text[length] == '\n') break;
            ++length;
        }
        close(ends[0]);
        name = ":" + std::to_string(std::atoi(text));
        setenv("DISPLAY", name.c_str(), 1);
    }
    ~Screen() {
        unsetenv("DISPLAY");
        kill(mProcess, SIGTERM);
        waitpid(mProcess, nullptr, 0);
    }
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// What is on it (X Window Dump, see XWDFile.h: big-endian words, then pixels).
    Image read(int width, int height) const {
        std::ifstream stream(mFile, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes.at(at)); };
        const auto word = [&](std::size_t at) {
            return std::size_t{byte(at)} << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 |
                   byte(at + 3);
        };
        const std::size_t start = word(0) + 12 * word(76), stride = word(48);
        Image image(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int channel = 0; channel < 3; ++channel)
                    image.at(x, y)[channel] = static_cast<float>(
                        linearFromSrgb(byte(start + y * stride + 4 * x + 2 - channel) / 255.0));
        return image;
    }

    std::string name;

  private:
    fs::path mFile;
    pid_t mProcess = -1;
};

/// A process that ends with its scope at the latest.
class Child {
  public:
    explicit Child(const std::string& command) : mProcess(fork()) {
        if (mProcess != 0) return;
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    ~Child() {
        if (mIsGone) return;
        kill(mProcess, SIGKILL);
        waitpid(mProcess, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    bool isGone() {
        mIsGone = mIsGone || waitpid(mProcess, &mStatus, WNOHANG) == mProcess;
        return mIsGone;
    }
    int exitCode() const { return WIFEXITED(mStatus) ? WEXITSTATUS(mStatus) : 128; }

  private:
    pid_t mProcess;
    int mStatus = 0;
    bool mIsGone = false;
};

// Keys and clicks go to the window as a user's would; its title says what they did.
TEST_F(ViewerTest, TrueWindow_FollowsKeysAndMouse) {
    if (!hasProgram("Xvfb") || !hasProgram("xdotool")) GTEST_SKIP() << "needs Xvfb and xdotool";
    const Screen screen(mFolder / "");
    Child viewer("cd " + path("") + " && exec " + command(""));
    const auto waitFor = [&](const std::string& condition) {
        for (int i = 0; i < 300; ++i) {
            if (runShell(condition + " >/dev/null 2>&1") == 0) return true;
            if (viewer.isGone()) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    };
    const auto titled = [](const std::string& title) {
        return "xdotool search --name '" + title + "'";
    };
    ASSERT_TRUE(waitFor(titled("^scene.json - sorted - brume$"))) << mFolder.read("log");
    runShell("xdotool search --name brume windowfocus");
    runShell("xdotool key m");
    EXPECT_TRUE(waitFor(titled("^scene.json - weighted - brume$")));
    // Drag the picture, save it; the file appears whole.
    runShell("xdotool mousemove 100 120 mousedown 1 mousemove 160 130 mousemove 200 130 mouseup 1");
    runShell("xdotool key p");
    ASSERT_TRUE(waitFor("test -s " + path("brume.png"))) << mFolder.read("log");
    const Image dragged = readImage(mFolder / "brume.png");
    EXPECT_FALSE(isBlank(dragged, 0, 0, dragged.width, dragged.height));
    // Another size of the window, then back home.
    fs::remove(mFolder / "brume.png");
    runShell(
        "xdotool search --name brume windowsize 400 260; xdotool key r; sleep 1; xdotool key p");
    ASSERT_TRUE(waitFor("test -s " + path("brume.png"))) << mFolder.read("log");
    const Image small = readImage(mFolder / "brume.png");
    EXPECT_LT(small.width, dragged.width);
    runShell("xdotool key ctrl+q");
    for (int i = 0; i < 300 && !viewer.isGone(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_TRUE(viewer.isGone());
    EXPECT_EQ(viewer.exitCode(), 0) << mFolder.read("log");
}

// The swapchain shows what the interface draws, colours in their places.
TEST_F(ViewerTest, TrueWindow_ShowsWhatIsDrawn) {
    if (!hasProgram("Xvfb")) GTEST_SKIP() << "needs Xvfb";
    const Screen screen(mFolder / "");
    mFolder.write("script", "wait settled\nframes 2\nwindow drawn.png\nframes 100\nquit\n");
    Child viewer("cd " + path("") + " && exec " + command("--script script"));
    for (int i = 0; i < 300 && !fs::exists(mFolder / "drawn.png") && !viewer.isGone(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_TRUE(fs::exists(mFolder / "drawn.png")) << mFolder.read("log");
    const Image drawn = readImage(mFolder / "drawn.png");
    double share = 1;
    for (int i = 0; i < 50 && share > 0.001; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        share = differingShare(drawn, screen.read(drawn.width, drawn.height));
    }
    EXPECT_LE(share, 0.001);
    EXPECT_FALSE(isBlank(drawn, 0, 0, drawn.width / 2, drawn.height));
}

#ifdef HOST_MINIMAL_EXECUTABLE
// The demo's renderer is a host that presents with semaphores of its own.
TEST_F(ViewerTest, HostMinimal_ShowsItsFramesInAWindow) {
    if (!hasProgram("Xvfb")) GTEST_SKIP() << "needs Xvfb";
    const Screen screen(mFolder / "");
    EXPECT_EQ(runShell("timeout 120 " HOST_MINIMAL_EXECUTABLE
                       " --window --validate --frames 3 --size 96x72 --start 1 >" +
                       path("log") + " 2>&1"),
              0)
        << mFolder.read("log");
}
#endif

}  // namespace
}  // namespace brume::view
