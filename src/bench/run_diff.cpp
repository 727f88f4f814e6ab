// SPDX-License-Identifier: Apache-2.0
#include <bench/run_diff.hpp>
#include <bench/statistics.hpp>
#include <core/error.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace brume::bench {
namespace {

using Json = nlohmann::json;

constexpr int kMostDepth = 16;

/// Below these, growth is rounding or bookkeeping.
constexpr double kLeastError = 1e-6, kLeastBytes = 65536, kLeastMs = 0.02;

/// No scatter excuses more: a change to half of all rows would scatter them as well.
constexpr double kMostNoise = 2;

/// Fewer rows say nothing about how far rows scatter.
constexpr std::size_t kLeastRows = 20;

/// So many methods of a scene say what its moment has done to all of them; and so many of a run's
/// scenes may have had another moment.
constexpr std::size_t kLeastRivals = 4;
constexpr double kOtherMoments = 0.05;

Json parse(const std::string& text, const std::string& name) {
    // What is nested deeper than results are is left out: copies would need the stack for it.
    const auto isShallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kMostDepth; };
    const Json json = Json::parse(text, isShallow, false);
    if (!json.is_object() || !json.contains("rows") || !json["rows"].is_array())
        throw inputError("comparing runs", name,
                         "is not a benchmark's result, allowed are files of brume bench --json");
    return json;
}

/// Members of another kind than they should be count as missing.
std::string textAt(const Json& row, const char* name, const char* fallback = "") {
    const auto found = row.find(name);
    return found != row.end() && found->is_string() ? found->get<std::string>() : fallback;
}

/// Strings without quotes; nothing that could be nested without end.
std::string scalarText(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_structured() ? "?" : value.dump();
}

std::string sceneOf(const Json& row) {
    const std::string suite = textAt(row, "suite");
    return suite + (suite.empty() ? "" : ": ") + textAt(row, "scene", "?");
}

/// With which shadows, and how large.
std::string shapeOf(const Json& row) {
    std::string shape;
    if (const std::string shadow = textAt(row, "shadow", "none"); shadow != "none")
        shape += " with " + shadow;
    if (const auto size = row.find("size");
        size != row.end() && size->is_array() && size->size() == 2)
        shape += fmt::format(" {}x{}", scalarText((*size)[0]), scalarText((*size)[1]));
    return shape;
}

/// Of rows that are measured in the same rounds.
std::string momentOf(const Json& row) { return sceneOf(row) + shapeOf(row); }

/// What is the same measurement in both runs.
std::string keyOf(const Json& row) {
    std::string key = sceneOf(row) + " by " + textAt(row, "method", "?") + shapeOf(row);
    if (const auto settings = row.find("settings");
        settings != row.end() && settings->is_object())
        for (const auto& [name, value] : settings->items())
            key += " " + name + "=" + scalarText(value);
    return key;
}

double numberAt(const Json& row, const char* group, const char* name, double fallback = 0) {
    const auto found = row.find(group);
    if (found == row.end() || !found->is_object()) return fallback;
    const auto value = found->find(name);
    return value != found->end() && value->is_number() ? value->get<double>() : fallback;
}

/// A time in units of the yardstick, or in ms without one.
struct Timing {
    double median = 0, lo = 0, hi = 0;

    Timing(const Json& row, bool isScaled) {
        const double unit = isScaled ? numberAt(row, "yardstickMs", "median", 1) : 1;
        median = numberAt(row, "timeMs", "median") / unit;
        lo = numberAt(row, "timeMs", "p05", median * unit) / unit;
        hi = numberAt(row, "timeMs", "p95", median * unit) / unit;
    }
};

/// A row of both runs.
struct Pair {
    std::string key;
    const Json* before;
    const Json* after;

    bool hasTimes() const {
        const bool isShort = numberAt(*before, "timeMs", "median") < kLeastMs;
        return !isShort && numberAt(*after, "timeMs", "median") > 0;
    }
    bool hasYardsticks() const {
        return before->contains("yardstickMs") && after->contains("yardstickMs");
    }
    /// Logarithm of how many times as long the row takes.
    double growth(bool isScaled) const {
        return std::log(Timing(*after, isScaled).median / Timing(*before, isScaled).median);
    }
};

/// How far times change from row to row about the change that all have in common: the standard
/// deviation of growth(), from the median deviation, which a few true changes do not move.
double findScatter(const std::vector<Pair>& pairs, bool isScaled) {
    std::vector<double> growths;
    for (const Pair& pair : pairs)
        if (pair.hasTimes() && (pair.hasYardsticks() || !isScaled)) {
            const double growth = pair.growth(isScaled);
            if (std::isfinite(growth)) growths.push_back(growth);
        }
    if (growths.size() < kLeastRows) return 0;
    const double common = percentile(growths, 0.5);
    for (double& growth : growths) growth = std::abs(growth - common);
    constexpr double kDeviationPerMedian = 1.4826;  // of a normal distribution
    return kDeviationPerMedian * percentile(growths, 0.5);
}

/// What rows of one scene, measured in the same rounds, have in common: the logarithm of how many times
/// as long half of them take at least.
class Moments {
  public:
    explicit Moments(const std::vector<Pair>& pairs) {
        for (const Pair& pair : pairs)
            if (pair.hasTimes() && pair.hasYardsticks() && std::isfinite(pair.growth(true)))
                mGrowths[momentOf(*pair.after)].push_back(pair.growth(true));
    }

    double common(const Pair& pair) const {
        const auto found = mGrowths.find(momentOf(*pair.after));
        if (found == mGrowths.end() || found->second.size() < kLeastRivals) return 0;
        return percentile(found->second, 0.5);
    }
    std::size_t count() const { return mGrowths.size(); }

  private:
    std::map<std::string, std::vector<double>> mGrowths;
};

class Differ {
  public:
    Differ(double threshold, const std::vector<Pair>& pairs, RunDiff& diff)
        : mThreshold(threshold), mDiff(diff), mMoments(pairs) {
        diff.scatter = findScatter(pairs, false);
        diff.scaledScatter = findScatter(pairs, true);
    }

    void compare(const Pair& pair) {
        const Json &before = *pair.before, &after = *pair.after;
        ++mDiff.comparedRows;
        const bool failedBefore = before.contains("failure"), fails = after.contains("failure");
        if (fails && !failedBefore)
            mDiff.regressions.push_back(pair.key + ": fails: " + textAt(after, "failure", "without a word"));
        if (failedBefore && !fails) mDiff.gains.push_back(pair.key + ": fails no longer");
        if (fails || failedBefore) return;
        if (pair.hasTimes()) compareTimes(pair);
        compareFigures(pair.key, before, after);
    }

    /// Once all rows are compared: disturbed scenes are few, those that a change of shared code meets
    /// are not.
    void finish() {
        const double most = kOtherMoments * static_cast<double>(mMoments.count());
        const bool areFew = static_cast<double>(mMomentary.size()) <= most;
        for (const auto& [scene, changes] : mMomentary)
            for (const Change& change : changes)
                if (areFew)
                    mDiff.notes.push_back(change.line + ", and so are its scene's other methods: another moment");
                else
                    change.list->push_back(change.line);
    }

  private:
    struct Change {
        std::vector<std::string>* list;
        std::string line;
    };

    void compareTimes(const Pair& pair) {
        const bool isScaled = pair.hasYardsticks();
        const Timing a(*pair.before, isScaled), b(*pair.after, isScaled);
        // A yardstick that was disturbed alone is no evidence: the times as they are must agree.
        const Timing rawA(*pair.before, false), rawB(*pair.after, false);
        const std::string line =
            fmt::format("{}: {:.2f} times as long{} ({:.3g} ms, was {:.3g} ms)", pair.key,
                        b.median / a.median, isScaled ? " by the yardstick" : "", rawB.median,
                        rawA.median);
        const double scatter = isScaled ? mDiff.scaledScatter : mDiff.scatter;
        if (isSlower(a, b, scatter) && isSlower(rawA, rawB, mDiff.scatter))
            add(pair, {&mDiff.regressions, line});
        if (isSlower(b, a, scatter) && isSlower(rawB, rawA, mDiff.scatter))
            add(pair, {&mDiff.gains, line});
    }

    void add(const Pair& pair, Change change) {
        const double common = mMoments.common(pair);
        const bool isCommon = std::abs(common) > std::log(1 + mThreshold) &&
                              std::abs(common) < std::log(kMostNoise) &&
                              std::abs(pair.growth(true) - common) < std::log(noise(mDiff.scaledScatter));
        if (isCommon)
            mMomentary[momentOf(*pair.after)].push_back(std::move(change));
        else
            change.list->push_back(std::move(change.line));
    }

    /// Of some hundred rows that scatter, some go as far as three deviations.
    double noise(double scatter) const {
        return std::max(1 + mThreshold, std::min(std::exp(3 * scatter), kMostNoise));
    }

    bool isSlower(const Timing& before, const Timing& after, double scatter) const {
        return after.median > before.median * noise(scatter) &&
               after.lo > before.hi * (1 + 0.5 * mThreshold);
    }

    void compareFigures(const std::string& key, const Json& before, const Json& after) {
        compareFigure(key, "rmse", numberAt(before, "error", "rmse", -1),
                      numberAt(after, "error", "rmse", -1), kLeastError);
        compareFigure(key, "bytes", numberAt(before, "bytes", "total", -1),
                      numberAt(after, "bytes", "total", -1), kLeastBytes);
        if (numberAt(after, "error", "nonFinite") > numberAt(before, "error", "nonFinite"))
            mDiff.regressions.push_back(
                fmt::format("{}: {:.0f} pixels are not finite", key, numberAt(after, "error", "nonFinite")));
        const bool isDeterministic = numberAt(before, "counters", "distinctImages") == 1 &&
                                     numberAt(after, "counters", "distinctImages") == 1;
        if (isDeterministic && textAt(before, "imageHash") != textAt(after, "imageHash"))
            mDiff.notes.push_back(key + ": another image");
    }

    void compareFigure(const std::string& key, const char* what, double before, double after,
                       double least) {
        if (before < 0 || after < 0) return;
        const std::string line = fmt::format("{}: {} {:.4g}, was {:.4g}", key, what, after, before);
        if (after > before * (1 + mThreshold) && after - before > least)
            mDiff.regressions.push_back(line);
        if (after * (1 + mThreshold) < before && before - after > least)
            mDiff.gains.push_back(line);
    }

    double mThreshold;
    RunDiff& mDiff;
    Moments mMoments;
    std::map<std::string, std::vector<Change>> mMomentary;  ///< by momentOf()
};

/// Rows of all kinds by key; shadow rows take the shape of the others.
std::map<std::string, Json> collectRows(const Json& run) {
    std::map<std::string, Json> rows;
    for (const Json& row : run["rows"])
        if (row.is_object()) rows[keyOf(row)] = row;
    const auto addOthers = [&](const char* list, const char* time, const auto& name) {
        const auto found = run.find(list);
        if (found == run.end() || !found->is_array()) return;
        for (const Json& row : *found) {
            if (!row.is_object()) continue;
            Json shaped = Json::object();
            if (const auto times = row.find(time); times != row.end()) shaped["timeMs"] = *times;
            if (row.contains("failure")) shaped["failure"] = row["failure"];
            if (const auto inside = row.find("inside"); inside != row.end() && inside->is_object())
                shaped["error"] = {{"rmse", numberAt(*inside, "footprint", "rms")}};
            rows[name(row)] = shaped;
        }
    };
    addOthers("shadows", "buildMs", [](const Json& row) {
        return "shadow store " + textAt(row, "shadow", "?") + " on " + textAt(row, "scene", "?");
    });
    addOthers("simulation", "timeMs",
              [](const Json& row) { return "simulate " + textAt(row, "name", "?"); });
    return rows;
}

void appendList(const char* title, const std::vector<std::string>& lines, std::string& text) {
    if (lines.empty()) return;
    text += fmt::format("{} ({})\n", title, lines.size());
    for (const std::string& line : lines) text += "  " + line + "\n";
}

}  // namespace

RunDiff diffRuns(const std::string& oldJson, const std::string& oldName,
                 const std::string& newJson, const std::string& newName, double threshold) {
    const Json before = parse(oldJson, oldName), after = parse(newJson, newName);
    const std::map<std::string, Json> oldRows = collectRows(before), newRows = collectRows(after);
    RunDiff diff;
    const auto device = [](const Json& run) {
        const auto machine = run.find("machine");
        return machine == run.end() || !machine->is_object() ? std::string()
                                                             : textAt(*machine, "device");
    };
    if (device(before) != device(after))
        diff.notes.push_back("other devices: " + device(before) + ", then " + device(after));
    std::vector<Pair> pairs;
    for (const auto& [key, row] : newRows) {
        const auto found = oldRows.find(key);
        if (found == oldRows.end())
            diff.notes.push_back(key + ": only in " + newName);
        else
            pairs.push_back({key, &found->second, &row});
    }
    Differ differ(threshold, pairs, diff);
    for (const Pair& pair : pairs) differ.compare(pair);
    differ.finish();
    for (const auto& [key, row] : oldRows)
        if (!newRows.contains(key)) diff.notes.push_back(key + ": only in " + oldName);
    return diff;
}

std::string formatDiff(const RunDiff& diff) {
    std::string text = fmt::format("{} rows in both runs\n", diff.comparedRows);
    if (diff.scaledScatter > 0)
        text += fmt::format("times scatter by {:.0f} % from row to row, by the yardstick {:.0f} %\n",
                            100 * diff.scatter, 100 * diff.scaledScatter);
    appendList("worse beyond noise", diff.regressions, text);
    appendList("better beyond noise", diff.gains, text);
    appendList("to note", diff.notes, text);
    if (diff.regressions.empty() && diff.gains.empty()) text += "no change beyond noise\n";
    return text;
}

}  // namespace brume::bench
