// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>

#include <algorithm>

namespace brume {
namespace {

std::string composeLine(const std::string& doing, const std::string& where,
                        const std::string& problem) {
    std::string line = doing + ": " + (where.empty() ? "" : where + ": ") + problem;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return line;
}

}  // namespace

Error inputError(const std::string& doing, const std::string& where, const std::string& problem) {
    return Error(ErrorKind::Input, composeLine(doing, where, problem));
}

Error failure(const std::string& doing, const std::string& where, const std::string& problem) {
    return Error(ErrorKind::Failure, composeLine(doing, where, problem));
}

}  // namespace brume
