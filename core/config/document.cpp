#include "core/config/document.hpp"

#include "core/config/source_text.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace gault::core::config {
namespace {

int depth_of(const Node& node) {
    int depth = 0;
    for (const auto& item : node.items)
        depth = std::max(depth, depth_of(item));
    return depth + 1;
}

// Builds the tree from the parser's events: its own node type forgets duplicate keys and follows cycles.
class TreeBuilder : public YAML::EventHandler {
  public:
    explicit TreeBuilder(const SourceText& source) : source_(source) {}

    Node root;
    bool any = false;

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (any) throw InputError(where(mark), "a second document begins; a scene is a single one");
        any = true;
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(Node{}, mark, anchor); }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& value) override {
        refuse_tag(mark, tag);
        refuse_control_characters(mark, value);
        Node node;
        node.kind = NodeKind::scalar;
        node.quoted = tag == "!";
        node.text = value;
        if (const auto quote = source_.unclosed_quote(offset(mark));
            node.quoted && quote != std::string::npos)
            throw InputError(source_.place(quote).location(), "a quote that is never closed");
        leaf(std::move(node), mark, anchor);
    }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const auto found = anchors_.find(anchor);
        if (found == anchors_.end())
            throw InputError(where(mark), "this alias stands inside the value that it repeats");
        if (open_.size() + static_cast<std::size_t>(depth_of(found->second)) > deepest) too_deep(mark);
        count(size_of(found->second), mark);
        add(found->second, mark);
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value style) override {
        open(NodeKind::list, mark, tag, anchor, style);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value style) override {
        open(NodeKind::map, mark, tag, anchor, style);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapEnd() override { close(); }

  private:
    struct Open {
        Node node;
        YAML::anchor_t anchor;
        YAML::Mark mark;
        std::optional<Key> key; // read, and waiting for its value
        std::unordered_map<std::string, Place> seen;
    };

    const SourceText& source_;
    std::vector<Open> open_;
    std::unordered_map<YAML::anchor_t, Node> anchors_;
    std::size_t nodes_ = 0;

    std::size_t offset(const YAML::Mark& mark) const { return source_.offset(mark.line, mark.column); }
    Place place(const YAML::Mark& mark) const { return source_.place(offset(mark)); }
    Location where(const YAML::Mark& mark) const { return place(mark).location(); }

    void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
        if (!tag.empty() && tag != "?" && tag != "!")
            throw InputError(where(mark), "a YAML tag (" + in_quotes(tag) + "); a scene has none");
    }
    void refuse_control_characters(const YAML::Mark& mark, const std::string& value) const {
        const auto control = [](unsigned char c) {
            return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F;
        };
        if (std::any_of(value.begin(), value.end(), control))
            throw InputError(where(mark), "a control character in " + in_quotes(value));
    }
    [[noreturn]] void too_deep(const YAML::Mark& mark) const {
        throw InputError(where(mark), "more than " + std::to_string(deepest) + " levels of nesting");
    }
    void count(std::size_t more, const YAML::Mark& mark) {
        nodes_ += more;
        if (nodes_ > most_nodes)
            throw InputError(where(mark), "more than " + std::to_string(most_nodes) +
                                              " values (aliases count as what they stand for)");
    }

    void open(NodeKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
              YAML::EmitterStyle::value style) {
        refuse_tag(mark, tag);
        count(1, mark);
        if (open_.size() >= deepest) too_deep(mark);
        if (awaits_key()) throw InputError(where(mark), "a key must be a single word");
        Open next{};
        next.node.kind = kind;
        next.node.flow = style == YAML::EmitterStyle::Flow;
        next.node.place = place(mark);
        next.anchor = anchor;
        next.mark = mark;
        open_.push_back(std::move(next));
    }

    void close() {
        Open done = std::move(open_.back());
        open_.pop_back();
        keep(done.anchor, done.node, done.mark);
        add(std::move(done.node), done.mark);
    }

    void leaf(Node node, const YAML::Mark& mark, YAML::anchor_t anchor) {
        count(1, mark);
        node.place = place(mark);
        if (node.kind == NodeKind::null && !open_.empty() && open_.back().key)
            node.place = open_.back().key->place; // the parser is already on the next line
        keep(anchor, node, mark);
        add(std::move(node), mark);
    }

    void keep(YAML::anchor_t anchor, const Node& node, const YAML::Mark& mark) {
        if (anchor == YAML::NullAnchor) return;
        count(size_of(node), mark);
        anchors_.insert_or_assign(anchor, node);
    }

    bool awaits_key() const {
        return !open_.empty() && open_.back().node.kind == NodeKind::map && !open_.back().key;
    }

    void add(Node node, const YAML::Mark& mark) {
        if (open_.empty()) {
            root = std::move(node);
        } else if (awaits_key()) {
            start_entry(node, mark);
        } else {
            Open& parent = open_.back();
            if (parent.key) parent.node.keys.push_back(*std::exchange(parent.key, std::nullopt));
            parent.node.items.push_back(std::move(node));
        }
    }

    void start_entry(const Node& key, const YAML::Mark& mark) {
        if (key.kind != NodeKind::scalar)
            throw InputError(where(mark), "a key must be a single word, not " + described(key));
        if (key.text.size() > longest_key)
            throw InputError(where(mark), "a key of more than " + std::to_string(longest_key) + " bytes");
        if (std::any_of(key.text.begin(), key.text.end(), [](unsigned char c) { return c < 0x20; }))
            throw InputError(where(mark), "a key must stand on one line");
        Open& map = open_.back();
        const auto [first, fresh] = map.seen.try_emplace(key.text, place(mark));
        if (!fresh)
            throw InputError(where(mark), "the key " + in_quotes(key.text) + " is written twice; first at " +
                                              first->second.location().text());
        map.key = Key{key.text, place(mark)};
    }
};

void write(YAML::Emitter& out, const Node& node) {
    switch (node.kind) {
    case NodeKind::null:
        out << YAML::Null;
        return;
    case NodeKind::scalar:
        if (node.quoted) out << YAML::DoubleQuoted;
        out << node.text;
        return;
    case NodeKind::list:
        out << (node.flow ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
        for (const auto& item : node.items)
            write(out, item);
        out << YAML::EndSeq;
        return;
    case NodeKind::map:
        out << (node.flow ? YAML::Flow : YAML::Block) << YAML::BeginMap;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            out << YAML::Key << node.keys[i].text << YAML::Value;
            write(out, node.items[i]);
        }
        out << YAML::EndMap;
        return;
    }
}

} // namespace

const Node* Node::find(std::string_view key) const {
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (keys[i].text == key) return &items[i];
    return nullptr;
}

std::size_t size_of(const Node& node) {
    std::size_t size = 1;
    for (const auto& item : node.items)
        size += size_of(item);
    return size;
}

std::string read_text(const std::filesystem::path& file) {
    const Location where{file.string()};
    std::error_code problem;
    const auto status = std::filesystem::status(file, problem);
    if (status.type() == std::filesystem::file_type::not_found) throw InputError(where, "no such file");
    if (std::filesystem::is_directory(status)) throw InputError(where, "a folder, not a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(where, "the file cannot be read");
    std::string text(largest_file + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (stream.bad()) throw InputError(where, "the file cannot be read");
    if (text.size() > largest_file) throw InputError(where, "larger than 1 MiB; not a scene");
    return text;
}

Node parse_document(std::string text, const std::string& file) {
    const SourceText source(std::move(text), file);
    TreeBuilder builder(source);
    try {
        std::istringstream stream(source.text());
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const YAML::Exception& error) {
        const auto offset = source.offset(error.mark.line, error.mark.column);
        throw InputError(source.place(offset).location(), "not valid YAML: " + error.msg);
    }
    return std::move(builder.root);
}

std::string emit(const Node& node) {
    YAML::Emitter out;
    write(out, node);
    return std::string(out.c_str()) + "\n";
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 80;
    std::string line(text.substr(0, longest));
    if (text.size() > longest) {
        while (!line.empty() && (line.back() & 0xC0) == 0x80) // never half a character
            line.pop_back();
        if (!line.empty() && (line.back() & 0x80)) line.pop_back();
        line += "...";
    }
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    return "'" + line + "'";
}

std::string described(const Node& node) {
    switch (node.kind) {
    case NodeKind::scalar:
        return in_quotes(node.text);
    case NodeKind::list:
        return "a list";
    case NodeKind::map:
        return "a map";
    case NodeKind::null:
        break;
    }
    return "nothing";
}

} // namespace gault::core::config
