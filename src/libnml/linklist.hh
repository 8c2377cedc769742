// SPDX-License-Identifier: GPL-2.0-or-later
//
// linklist.hh - a list of blocks of data, kept as copies or as pointers, with a current node.
//
// Node ids grow from 1 and are never used again. Every function that gives data gives null
// when there is none. [any] non-realtime thread; an object belongs to one thread at a time.
#ifndef KERF_LINKLIST_HH
#define KERF_LINKLIST_HH

#include <cstddef>
#include <list>

// What a list with a greatest size does when it is full and more is stored.
enum LIST_SIZING_MODE { DELETE_FROM_HEAD = 0, DELETE_FROM_TAIL = 1, STOP_AT_MAX = 2, NO_MAXIMUM_SIZE = 3 };

struct LinkedListNode {
    void *data;
    size_t size;
    int id;
    bool copied; // the list owns data
};

class LinkedList {
public:
    LinkedList() = default;
    ~LinkedList() { flush_list(); }
    LinkedList(const LinkedList &) = delete;
    LinkedList &operator=(const LinkedList &) = delete;

    // Store `size` bytes (copy) or the pointer. The id of the node; -1: no room, or no current node.
    int store_at_head(void *data, size_t size, bool copy);
    int store_at_tail(void *data, size_t size, bool copy);
    int store_before_current_node(void *data, size_t size, bool copy);
    int store_after_current_node(void *data, size_t size, bool copy);

    // These make the node that they give the current one.
    void *get_head();
    void *get_tail();
    void *get_next();                      // after the current node
    void *get_last();                      // before the current node
    void *find_node(int nth);              // from 0
    void *get_by_id(int id);
    void *get_first_newer(int id);         // the first from the head with a greater id
    void *get_last_newer(int id);          // the first from the tail with a greater id

    // Take a node out; a copy belongs to the caller then (free it with operator delete).
    void *retrieve_head();
    void *retrieve_tail();

    void delete_node(int id);
    void delete_current_node();            // the node before it becomes the current one
    void flush_list();                     // all, with the copies
    void delete_members();                 // all; frees with operator delete what was stored as a pointer too

    void set_list_sizing_mode(int max_size, LIST_SIZING_MODE mode);
    bool is_empty() const { return nodes_.empty(); }
    int get_current_id() const { return current_ == nodes_.end() ? -1 : current_->id; }

    int list_size = 0; // nodes

private:
    using Place = std::list<LinkedListNode>::iterator;
    int store(Place before, void *data, size_t size, bool copy);
    void *go_to(Place place);
    void *retrieve(Place place);
    Place erase(Place place);
    std::list<LinkedListNode> nodes_;
    Place current_ = nodes_.end();
    int last_id_ = 0, max_size_ = 0;
    LIST_SIZING_MODE mode_ = NO_MAXIMUM_SIZE;
};

#endif
