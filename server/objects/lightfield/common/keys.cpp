#include "objects/lightfield/common/keys.h"

#include <span>

#include "objects/lightfield/common/packed_camera.h"

namespace grove::objects::lightfield {
namespace {

node::Key asKey(node::PackWriter& writer) {
  const node::PackedBytes bytes = writer.take();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

node::PackReader readerOf(const node::Key& key) { return {std::as_bytes(std::span(key)), "a light field's key"}; }

}  // namespace

node::Key keyOf(const CellId& id) {
  node::PackWriter writer;
  for (const std::int32_t part : {id.focal, id.shell, id.layer, id.band, id.column, id.error, id.version})
    writer.put(part);
  writer.put(static_cast<std::uint8_t>(id.coarse));
  return asKey(writer);
}

CellId cellIdOf(const node::Key& key) {
  node::PackReader reader = readerOf(key);
  CellId id;
  for (std::int32_t* const part : {&id.focal, &id.shell, &id.layer, &id.band, &id.column, &id.error, &id.version}) {
    *part = reader.take<std::int32_t>();
  }
  id.coarse = reader.takeWithin<std::uint8_t>(0, 1) == 1;
  reader.finish();
  return id;
}

node::Key keyOf(const OwnPicture& picture) {
  node::PackWriter writer;
  putCamera(writer, picture.camera);
  writer.put(static_cast<std::uint8_t>(picture.mustBeMade)).put(static_cast<std::uint8_t>(picture.faces));
  return asKey(writer);
}

OwnPicture ownPictureOf(const node::Key& key) {
  node::PackReader reader = readerOf(key);
  OwnPicture picture;
  picture.camera = takeCamera(reader);
  picture.mustBeMade = reader.takeWithin<std::uint8_t>(0, 1) == 1;
  picture.faces = reader.takeWithin<std::uint8_t>(0, 1) == 1;
  reader.finish();
  return picture;
}

}  // namespace grove::objects::lightfield
