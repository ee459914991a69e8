#include "engine/rigid/held_contacts.h"

namespace scree::rigid {

HeldContact& HeldContacts::add(const std::array<int, 2>& blocks) {
  if (unused_.empty()) {
    memory_.push_back(std::make_unique<Chunk>());
    for (auto contact = memory_.back()->rbegin(); contact != memory_.back()->rend(); ++contact) unused_.push_back(&*contact);
  }
  HeldContact& contact = *unused_.back();
  unused_.pop_back();
  contact = {};
  contact.blocks = blocks;
  contact.place = static_cast<int>(all_.size());
  all_.push_back(&contact);
  return contact;
}

// The last one takes its place.
void HeldContacts::remove(HeldContact& contact) {
  all_.back()->place = contact.place;
  all_[contact.place] = all_.back();
  all_.pop_back();
  unused_.push_back(&contact);
}

}  // namespace scree::rigid
