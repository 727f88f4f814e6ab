// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace brume::app {
namespace {

/// A file for one stream: unlike a pipe it can never block the command.
class Capture {
  public:
    Capture() : mDescriptor(mkstemp(mName)) {
        if (mDescriptor < 0) throw std::runtime_error("no temporary file");
    }
    ~Capture() {
        close(mDescriptor);
        unlink(mName);
    }
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;

    int descriptor() const { return mDescriptor; }
    std::string read() const {
        std::ifstream stream(mName, std::ios::binary);
        std::stringstream text;
        text << stream.rdbuf();
        return text.str();
    }

  private:
    char mName[32] = "/tmp/brume_test_XXXXXX";
    int mDescriptor;
};

void limit(int resource, rlim_t value) {
    const rlimit both{value, value};
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

[[noreturn]] void becomeBrume(const std::vector<std::string>& arguments, const Limits& limits,
                              const Capture& out, const Capture& err) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out.descriptor(), STDOUT_FILENO);
    dup2(err.descriptor(), STDERR_FILENO);
    limit(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds));
#ifndef BRUME_SANITIZED
    if (limits.addressMiB > 0) limit(RLIMIT_AS, static_cast<rlim_t>(limits.addressMiB) << 20);
#endif
    if (!limits.environment.empty()) putenv(const_cast<char*>(limits.environment.c_str()));
    std::vector<char*> words = {const_cast<char*>(BRUME_EXECUTABLE)};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    execv(BRUME_EXECUTABLE, words.data());
    _exit(127);
}

Outcome run(const std::vector<std::string>& arguments, const Limits& limits,
            const std::function<bool()>& isEnough) {
    const Capture out, err;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) becomeBrume(arguments, limits, out, err);
    int status = 0;
    rusage usage{};
    while (isEnough && wait4(child, &status, WNOHANG, &usage) == 0) {
        if (isEnough()) {
            kill(child, SIGKILL);
            break;
        }
        usleep(1000);
    }
    wait4(child, &status, 0, &usage);  // fails, and changes nothing, where it was waited for above
    Outcome outcome;
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = out.read();
    outcome.err = err.read();
    outcome.maxResidentMiB = usage.ru_maxrss / 1024;
    return outcome;
}

}  // namespace

Outcome runBrume(const std::vector<std::string>& arguments, const Limits& limits) {
    return run(arguments, limits, {});
}

Outcome runBrumeUntil(const std::vector<std::string>& arguments,
                      const std::function<bool()>& isEnough) {
    return run(arguments, {}, isEnough);
}

bool isOneErrorLine(const std::string& err) {
    return err.starts_with("brume: ") && err.ends_with("\n") &&
           std::count(err.begin(), err.end(), '\n') == 1;
}

}  // namespace brume::app
