// SPDX-License-Identifier: GPL-2.0-or-later
//
// linklist.cc - see linklist.hh.
#include "linklist.hh"

#include <algorithm>
#include <cstring>
#include <new>

int LinkedList::store(Place before, void *data, size_t size, bool copy) {
    if (mode_ != NO_MAXIMUM_SIZE && list_size >= max_size_) {
        if (mode_ == STOP_AT_MAX || nodes_.empty()) return -1;
        const Place out = mode_ == DELETE_FROM_HEAD ? nodes_.begin() : std::prev(nodes_.end());
        if (out == before) ++before;
        erase(out);
    }
    LinkedListNode node{data, size, ++last_id_, copy};
    if (copy) node.data = std::memcpy(::operator new(size), data, size);
    nodes_.insert(before, node);
    list_size++;
    return node.id;
}

int LinkedList::store_at_head(void *data, size_t size, bool copy) { return store(nodes_.begin(), data, size, copy); }
int LinkedList::store_at_tail(void *data, size_t size, bool copy) { return store(nodes_.end(), data, size, copy); }

int LinkedList::store_before_current_node(void *data, size_t size, bool copy) {
    return current_ == nodes_.end() ? -1 : store(current_, data, size, copy);
}

int LinkedList::store_after_current_node(void *data, size_t size, bool copy) {
    return current_ == nodes_.end() ? -1 : store(std::next(current_), data, size, copy);
}

void *LinkedList::go_to(Place place) {
    if (place == nodes_.end()) return nullptr; // the current node stays
    current_ = place;
    return place->data;
}

void *LinkedList::get_head() { return go_to(nodes_.begin()); }
void *LinkedList::get_tail() { return nodes_.empty() ? nullptr : go_to(std::prev(nodes_.end())); }
void *LinkedList::get_next() { return current_ == nodes_.end() ? nullptr : go_to(std::next(current_)); }
void *LinkedList::get_last() {
    return current_ == nodes_.end() || current_ == nodes_.begin() ? nullptr : go_to(std::prev(current_));
}
void *LinkedList::find_node(int nth) {
    return nth < 0 || nth >= list_size ? nullptr : go_to(std::next(nodes_.begin(), nth));
}

void *LinkedList::get_by_id(int id) {
    return go_to(std::find_if(nodes_.begin(), nodes_.end(), [id](const LinkedListNode &n) { return n.id == id; }));
}

void *LinkedList::get_first_newer(int id) {
    return go_to(std::find_if(nodes_.begin(), nodes_.end(), [id](const LinkedListNode &n) { return n.id > id; }));
}

void *LinkedList::get_last_newer(int id) {
    auto found = std::find_if(nodes_.rbegin(), nodes_.rend(), [id](const LinkedListNode &n) { return n.id > id; });
    return found == nodes_.rend() ? nullptr : go_to(std::prev(found.base()));
}

void *LinkedList::retrieve(Place place) {
    void *data = place->data;
    place->copied = false; // the caller's now
    erase(place);
    return data;
}

void *LinkedList::retrieve_head() { return nodes_.empty() ? nullptr : retrieve(nodes_.begin()); }
void *LinkedList::retrieve_tail() { return nodes_.empty() ? nullptr : retrieve(std::prev(nodes_.end())); }

LinkedList::Place LinkedList::erase(Place place) {
    if (place == current_) current_ = place == nodes_.begin() ? nodes_.end() : std::prev(place);
    if (place->copied) ::operator delete(place->data);
    list_size--;
    return nodes_.erase(place);
}

void LinkedList::delete_node(int id) {
    auto found = std::find_if(nodes_.begin(), nodes_.end(), [id](const LinkedListNode &n) { return n.id == id; });
    if (found != nodes_.end()) erase(found);
}

void LinkedList::delete_current_node() {
    if (current_ != nodes_.end()) erase(current_);
}

void LinkedList::flush_list() {
    while (!nodes_.empty()) erase(nodes_.begin());
    current_ = nodes_.end();
}

void LinkedList::delete_members() {
    for (LinkedListNode &n : nodes_) n.copied = true;
    flush_list();
}

void LinkedList::set_list_sizing_mode(int max_size, LIST_SIZING_MODE mode) {
    max_size_ = max_size;
    mode_ = mode;
    if (mode == NO_MAXIMUM_SIZE) return;
    while (list_size > max_size) erase(mode == DELETE_FROM_HEAD ? nodes_.begin() : std::prev(nodes_.end()));
}
