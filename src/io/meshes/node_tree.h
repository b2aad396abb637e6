// The tree of nodes in a file, seen before Assimp descends into it: it calls itself for every level, so a circle or a
// great depth ends in a full stack, and it copies what hangs under several parents, each time anew.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// Any skeleton has fewer levels, and any stack holds more.
inline constexpr std::size_t deepest_nesting = 200, deepest_node = 1000;

/// `children_of(node)` lists the nodes below one. Empty if the tree can be walked in about as many steps as there are
/// nodes, else what is wrong with it.
template <class Node, class ChildrenOf>
std::string problem_of_tree(const std::vector<Node>& roots, std::size_t nodes, ChildrenOf&& children_of) {
    struct Visit {
        Node node;
        std::size_t depth;
    };
    std::vector<Visit> open;
    for (const Node& root : roots) open.push_back({root, 1});
    // Some exporters name a node twice; many that do are an attack.
    std::size_t left = 4 * nodes + 100;
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (visit.depth > deepest_node) return "has nodes that lie more than " + std::to_string(deepest_node) + " deep";
        if (left-- == 0) return "has nodes that lie under themselves, or under many others at once";
        for (const Node& child : children_of(visit.node)) open.push_back({child, visit.depth + 1});
    }
    return {};
}

}  // namespace weft
