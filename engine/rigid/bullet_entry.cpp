#include "engine/rigid/bullet_room.h"

decltype(&scree::rigid::bullet::settle) scree_bullet_settle() {
  return scree::rigid::bullet::settle;
}
