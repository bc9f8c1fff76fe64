// The fuzzer's promise, kept by every compiler: all scenes of the corpus and mutations of them, always the
// same ones.
#include "tests/bad_scenes/check_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

namespace gault::core {
namespace {

std::vector<std::string> corpus() {
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"good", "scenes"})
        for (const auto& entry :
             std::filesystem::directory_iterator(std::string(GAULT_SOURCE_DIR "/tests/bad_scenes/") + folder))
            if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const auto& file : files) {
        std::ostringstream text;
        text << std::ifstream(file, std::ios::binary).rdbuf();
        texts.push_back(text.str());
    }
    return texts;
}

class Mutator {
  public:
    explicit Mutator(std::vector<std::string> texts) : texts_(std::move(texts)) {}

    std::string next() {
        std::string text = texts_[below(texts_.size())];
        for (std::size_t n = 1 + below(4); n > 0; --n)
            mutate(text);
        return text;
    }

  private:
    std::vector<std::string> texts_;
    std::mt19937_64 random_{42};

    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

    std::string snippet() {
        static const std::vector<std::string> words = {"{",
                                                       "}",
                                                       "[",
                                                       "]",
                                                       ":",
                                                       ": ",
                                                       "-",
                                                       "- ",
                                                       "&a ",
                                                       "*a",
                                                       "!t ",
                                                       "\"",
                                                       "'",
                                                       "|",
                                                       ">",
                                                       "?",
                                                       "~",
                                                       "#",
                                                       "%",
                                                       "\t",
                                                       "\n",
                                                       "\n  ",
                                                       ",",
                                                       "---\n",
                                                       "...\n",
                                                       "null",
                                                       "auto",
                                                       "0",
                                                       "-1",
                                                       "1e999",
                                                       "nan",
                                                       "1e308",
                                                       "99999999999999999999",
                                                       "<<",
                                                       "kPa",
                                                       "mm",
                                                       "\\",
                                                       "\xff",
                                                       "\xc3\xa9",
                                                       std::string(1, '\0'),
                                                       "geometric",
                                                       "axis",
                                                       "top",
                                                       "inner"};
        return words[below(words.size())];
    }

    void mutate(std::string& text) {
        const std::size_t at = below(text.size() + 1), length = below(1 + text.size() - at);
        switch (below(6)) {
        case 0:
            text.insert(at, snippet());
            break;
        case 1:
            text.erase(at, 1 + below(8));
            break;
        case 2:
            text.replace(at, std::min<std::size_t>(length, 4), snippet());
            break;
        case 3:
            text.resize(at);
            break;
        case 4:
            text.insert(at, text.substr(below(text.size()), below(60)));
            break;
        default:
            if (at < text.size()) text[at] = static_cast<char>(below(256));
        }
    }
};

TEST(SceneReader, AnswersTheCorpusWithASceneOrAnInputError) {
    for (const auto& text : corpus())
        EXPECT_EQ(broken_promise(text), "") << text;
}

TEST(SceneReader, AnswersMutationsWithASceneOrAnInputError) {
    Mutator mutator(corpus());
    for (int i = 0; i < 5000; ++i) {
        const std::string text = mutator.next();
        ASSERT_EQ(broken_promise(text), "") << "mutation " << i << ":\n" << text;
    }
}

TEST(SceneReader, AnswersEveryBeginningOfASceneWithASceneOrAnInputError) {
    const std::string text = corpus().front();
    for (std::size_t length = 0; length < text.size(); ++length)
        ASSERT_EQ(broken_promise(text.substr(0, length)), "") << text.substr(0, length);
}

} // namespace
} // namespace gault::core
