// SPDX-License-Identifier: Apache-2.0
#include <scene/json_document.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace brume::scene {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxKeyBytes = 256;
/// Products of two numbers must stay finite in single precision.
constexpr double kMaxNumber = 1e30;

/// Walks the text beside the parser. Between two of the parser's events there is nothing but white
/// space, comments, commas and colons, so that the next token's place can be found again.
class TokenCursor {
  public:
    explicit TokenCursor(std::string_view text) : mText(text) {
        if (mText.substr(0, 3) == "\xef\xbb\xbf") mOffset = mLineStart = 3;  // byte order mark
    }

    /// Skips to the next token and past it; returns where it starts.
    TextPlace next() {
        skipGap();
        const TextPlace place{mLine, static_cast<std::uint32_t>(mOffset - mLineStart + 1)};
        skipToken();
        return place;
    }

    /// The text of the next token, without going there.
    std::string_view show() const {
        TokenCursor ahead = *this;
        ahead.skipGap();
        const std::size_t begin = std::min(ahead.mOffset, mText.size());
        ahead.skipToken();
        return mText.substr(begin, ahead.mOffset - begin);
    }

  private:
    char peek(std::size_t ahead = 0) const {
        return mOffset + ahead < mText.size() ? mText[mOffset + ahead] : '\0';
    }

    void advance() {
        if (mText[mOffset++] == '\n') ++mLine, mLineStart = mOffset;
    }

    void skipGap() {
        while (mOffset < mText.size()) {
            const char c = peek();
            if (c == '/' && peek(1) == '/') {
                while (mOffset < mText.size() && peek() != '\n' && peek() != '\r') advance();
            } else if (c == '/' && peek(1) == '*') {
                mOffset += 2;
                while (mOffset < mText.size() && !(peek() == '*' && peek(1) == '/')) advance();
                mOffset = std::min(mOffset + 2, mText.size());
            } else if (std::string_view(" \t\r\n,:").find(c) != std::string_view::npos) {
                advance();
            } else {
                return;
            }
        }
    }

    void skipToken() {
        if (peek() == '"') {
            for (++mOffset; mOffset < mText.size() && peek() != '"'; ++mOffset)
                if (peek() == '\\') ++mOffset;
            ++mOffset;
        } else if (std::string_view("{}[]").find(peek()) != std::string_view::npos) {
            ++mOffset;
        } else {
            const std::string_view ends = " \t\r\n,:{}[]/\"";
            while (mOffset < mText.size() && ends.find(peek()) == std::string_view::npos) ++mOffset;
        }
    }

    std::string_view mText;
    std::size_t mOffset = 0;
    std::size_t mLineStart = 0;
    std::uint32_t mLine = 1;
};

/// Receives the parser's events and builds the values and, in parallel, their places.
class TreeBuilder {
  public:
    TreeBuilder(std::string_view text, const JsonRules& rules)
        : mCursor(text), mText(text), mRules(rules) {}

    json root;
    PlaceTree places;

    /// The parser takes a zero byte for the end and would be silent about what follows.
    void refuseZeroBytes() const {
        const std::size_t zero = mText.find('\0');
        if (zero != std::string_view::npos)
            throw error(placeOf(zero + 1), "a zero byte, allowed is text");
    }

    bool null() { return addScalar(json()); }
    bool boolean(bool value) { return addScalar(json(value)); }
    bool number_integer(std::int64_t value) { return addScalar(json(value)); }
    bool number_unsigned(std::uint64_t value) { return addScalar(json(value)); }
    bool string(std::string& value) { return addScalar(json(std::move(value))); }
    bool binary(json::binary_t&) { return false; }  // JSON texts have none

    bool number_float(double value, const std::string& text) {
        if (mRules.isStrict && std::abs(value) > kMaxNumber)
            throw error(mCursor.next(), fmt::format("the number {} is too large, at most 1e30 is "
                                                    "allowed",
                                                    quoteForMessage(text)));
        return addScalar(json(value));
    }

    bool start_object(std::size_t) { return open(json::object()); }
    bool start_array(std::size_t) { return open(json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        mKeyPlace = mCursor.next();
        if (name.size() > kMaxKeyBytes)
            throw error(mKeyPlace, fmt::format("a key of {} bytes, at most {} are allowed",
                                               name.size(), kMaxKeyBytes));
        if (mRules.isStrict && mStack.back().value->contains(name))
            throw error(mKeyPlace, fmt::format("key \"{}\": given twice in one object, once is "
                                               "allowed",
                                               quoteForMessage(name)));
        mKey = std::move(name);
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception& exception) {
        const std::string_view token = mCursor.show();
        if (exception.id == kNumberOverflow || isMeantToBeNotFinite(token))
            throw error(placeOf(position),
                        fmt::format("{}{} is no number, finite ones up to 1e30 are allowed",
                                    mKey.empty() ? "" : "key \"" + quoteForMessage(mKey) + "\": ",
                                    quoteForMessage(std::string(token))));
        throw error(placeOf(position), withoutPrefix(exception.what()));
    }

  private:
    static constexpr int kNumberOverflow = 406;  // of the parser

    /// What other programs write for numbers that JSON does not have.
    static bool isMeantToBeNotFinite(std::string_view token) {
        if (token.substr(0, 1) == "-" || token.substr(0, 1) == "+") token.remove_prefix(1);
        std::string lower(token);
        for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return lower == "nan" || lower == "inf" || lower == "infinity";
    }

    struct Level {
        json* value;
        PlaceTree* places;
    };

    Error error(const TextPlace& place, const std::string& problem) const {
        return inputError(mRules.doing,
                          fmt::format("{}:{}:{}", mRules.name, place.line, place.column), problem);
    }

    /// Line and column of the byte that the parser read last.
    TextPlace placeOf(std::size_t position) const {
        const std::size_t offset = std::min(position > 0 ? position - 1 : 0, mText.size());
        TextPlace place;
        for (std::size_t i = 0; i < offset; ++i)
            if (mText[i] == '\n')
                ++place.line, place.column = 1;
            else
                ++place.column;
        return place;
    }

    /// The parser's own text, without its error number and place.
    static std::string withoutPrefix(std::string message) {
        for (const char* mark : {"] ", "column "}) {
            const std::size_t found = message.find(mark);
            if (found != std::string::npos) message.erase(0, found + std::string_view(mark).size());
        }
        const std::size_t colon = message.find(": ");
        if (colon != std::string::npos && colon < 20 &&
            message.find_first_not_of("0123456789") == colon)
            message.erase(0, colon + 2);
        return quoteForMessage(message, 300);
    }

    Level add(json&& value, const TextPlace& place) {
        Level level{&root, &places};
        if (!mStack.empty()) {
            const Level& parent = mStack.back();
            if (parent.value->is_array()) {
                level.value = &parent.value->emplace_back();
                if (mRules.keepPlaces) level.places = &parent.places->items.emplace_back();
            } else {
                level.value = &(*parent.value)[mKey];
                if (mRules.keepPlaces) level.places = &parent.places->members[mKey];
                level.places->key = mKeyPlace;
            }
        }
        *level.value = std::move(value);
        level.places->value = place;
        return level;
    }

    bool addScalar(json&& value) {
        add(std::move(value), mCursor.next());
        return true;
    }

    bool open(json&& container) {
        const TextPlace place = mCursor.next();
        if (mStack.size() >= kMaxDepth)
            throw error(place, fmt::format("nested more than {} deep", kMaxDepth));
        mStack.push_back(add(std::move(container), place));
        return true;
    }

    bool close() {
        mCursor.next();
        mStack.pop_back();
        return true;
    }

    TokenCursor mCursor;
    std::string_view mText;
    const JsonRules& mRules;
    std::vector<Level> mStack;
    std::string mKey;
    TextPlace mKeyPlace;
};

}  // namespace

JsonDocument::JsonDocument(JsonRules rules, std::unique_ptr<json> root, PlaceTree places)
    : mRules(std::move(rules)), mRoot(std::move(root)), mPlaces(std::move(places)) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

JsonDocument JsonDocument::parse(const std::string& text, JsonRules rules) {
    if (text.size() > rules.maxBytes)
        throw inputError(
            rules.doing, rules.name,
            fmt::format("{} bytes of text, at most {} are allowed", text.size(), rules.maxBytes));
    TreeBuilder builder(text, rules);
    builder.refuseZeroBytes();
    json::sax_parse(text, &builder, json::input_format_t::json, true, /*ignore_comments=*/true);
    auto root = std::make_unique<json>(std::move(builder.root));
    PlaceTree places = std::move(builder.places);
    return JsonDocument(std::move(rules), std::move(root), std::move(places));
}

std::string JsonDocument::readText(const JsonRules& rules) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(rules.name, error))
        throw inputError(rules.doing, rules.name, "no such file");
    const std::uintmax_t size = std::filesystem::file_size(rules.name, error);
    if (error || size > rules.maxBytes)
        throw inputError(rules.doing, rules.name,
                         fmt::format("too long, at most {} bytes are allowed", rules.maxBytes));
    std::string text(static_cast<std::size_t>(size), '\0');
    std::ifstream stream(rules.name, std::ios::binary);
    if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())))
        throw inputError(rules.doing, rules.name, "cannot be read");
    return text;
}

std::string JsonDocument::where(const TextPlace& place) const {
    return fmt::format("{}:{}:{}", mRules.name, place.line, place.column);
}

Error JsonDocument::error(const TextPlace& place, const std::string& problem) const {
    return inputError(mRules.doing, where(place), problem);
}

std::string quoteForMessage(const std::string& text, std::size_t limit) {
    std::string result;
    for (std::size_t i = 0; i < text.size() && i < limit; ++i)
        result += static_cast<unsigned char>(text[i]) < 0x20 ? '?' : text[i];
    // Do not end in the middle of a UTF-8 sequence.
    if (text.size() > limit) {
        while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0xc0) == 0x80)
            result.pop_back();
        if (!result.empty() && static_cast<unsigned char>(result.back()) >= 0xc0) result.pop_back();
        result += "...";
    }
    return result;
}

}  // namespace brume::scene
