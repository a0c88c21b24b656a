// SPDX-License-Identifier: GPL-3.0-or-later
// What web-ifc finds in an IFC file, as JSON: node web_ifc_look.cjs MODULES FILE.ifc
const fs = require('fs');
const W = require(process.argv[2] + '/node_modules/web-ifc/web-ifc-api-node.js');

function valueOf(handle) { return handle === null || handle === undefined ? null : handle.value ?? null; }

(async () => {
  const api = new W.IfcAPI();
  await api.Init();
  api.SetLogLevel(W.LogLevel?.LOG_LEVEL_OFF ?? 6);
  const model = api.OpenModel(new Uint8Array(fs.readFileSync(process.argv[3])), { COORDINATE_TO_ORIGIN: false });
  const all = type => { const ids = api.GetLineIDsWithType(model, type); return Array.from({ length: ids.size() }, (_, i) => ids.get(i)); };
  const line = id => api.GetLine(model, id);
  const out = { schema: api.GetModelSchema(model), objects: {}, storeys: {} };
  const of_line = {};
  const object = id => {
    if (!(id in of_line)) {
      const l = line(id);
      of_line[id] = out.objects[valueOf(l.GlobalId)] = {
        class: api.GetNameFromTypeCode(l.type), name: valueOf(l.Name), tag: valueOf(l.Tag), predefined: valueOf(l.PredefinedType),
        sets: {}, materials: [], triangles: 0, place: null, whole: null, type: null, layers: []
      };
    }
    return of_line[id];
  };
  const typed = value => value ? [value.constructor?.name ?? null, value.value] : null;
  // Kind or type of the value, value, unit. The value of one with several is a list, and of one with bounds or parts an object.
  const rowOf = property => {
    const kind = property.constructor.name, several = property.ListValues ?? property.EnumerationValues;
    const parts = property.HasProperties ?? property.HasQuantities;
    if (parts) return [kind, Object.fromEntries(parts.map(p => line(p.value)).map(p => [valueOf(p.Name), rowOf(p)])), null];
    const unit = property.Unit ? line(property.Unit.value) : null, named = unit ? [valueOf(unit.Prefix), valueOf(unit.Name)] : null;
    if (several) return [kind, several.map(typed), named];
    if ('SetPointValue' in property) return [kind, ['LowerBoundValue', 'UpperBoundValue', 'SetPointValue'].map(k => typed(property[k])), named];
    const value = property[Object.keys(property).find(k => /^(NominalValue|\w+Value)$/.test(k))];
    return [kind.startsWith('IfcQuantity') ? kind : value?.constructor?.name ?? null, value ? value.value : null, named];
  };
  for (const id of all(W.IFCRELDEFINESBYPROPERTIES)) {
    const relation = line(id), set = line(relation.RelatingPropertyDefinition.value), rows = {};
    for (const p of set.HasProperties ?? set.Quantities ?? []) {
      const property = line(p.value);
      rows[valueOf(property.Name)] = rowOf(property);
    }
    for (const o of relation.RelatedObjects) {
      const sets = object(o.value).sets;
      sets[valueOf(set.Name)] = { ...sets[valueOf(set.Name)], ...rows };
    }
  }
  for (const id of all(W.IFCRELCONTAINEDINSPATIALSTRUCTURE)) {
    const relation = line(id), place = valueOf(line(relation.RelatingStructure.value).GlobalId);
    for (const o of relation.RelatedElements) object(o.value).place = place;
  }
  for (const id of all(W.IFCRELAGGREGATES)) {
    const relation = line(id), whole = valueOf(line(relation.RelatingObject.value).GlobalId);
    for (const o of relation.RelatedObjects) object(o.value).whole = whole;
  }
  for (const id of all(W.IFCRELDEFINESBYTYPE)) {
    const relation = line(id), type = line(relation.RelatingType.value);
    for (const o of relation.RelatedObjects) object(o.value).type = valueOf(type.Name);
  }
  const materials = id => {
    const l = line(id);
    if (l.ForLayerSet) return materials(l.ForLayerSet.value);
    if (l.MaterialLayers) return l.MaterialLayers.flatMap(x => { const y = line(x.value); return [[valueOf(line(y.Material.value).Name), y.LayerThickness.value]]; });
    if (l.Materials) return l.Materials.map(x => valueOf(line(x.value).Name));
    if (l.MaterialConstituents) return l.MaterialConstituents.map(x => valueOf(line(line(x.value).Material.value).Name));
    return [valueOf(l.Name)];
  };
  for (const id of all(W.IFCRELASSOCIATESMATERIAL)) {
    const relation = line(id);
    for (const o of relation.RelatedObjects) object(o.value).materials = materials(relation.RelatingMaterial.value);
  }
  const conversions = all(W.IFCMAPCONVERSION).map(line);
  out.map = conversions.map(c => [c.Eastings.value, c.Northings.value, c.OrthogonalHeight.value, valueOf(line(c.TargetCRS.value).Name)]);
  api.StreamAllMeshes(model, mesh => {
    const o = object(mesh.expressID);
    o.min = [1e300, 1e300, 1e300];
    o.max = [-1e300, -1e300, -1e300];
    for (let i = 0; i < mesh.geometries.size(); i++) {
      const placed = mesh.geometries.get(i), m = placed.flatTransformation, geometry = api.GetGeometry(model, placed.geometryExpressID);
      const points = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
      const corners = api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
      o.triangles += corners.length / 3;
      for (const c of corners) {
        const p = [0, 1, 2].map(k => points[6 * c + k]);
        // web-ifc turns Y up: back to Z up
        const q = [0, 1, 2].map(k => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k]);
        const z = [q[0], -q[2], q[1]];
        for (let k = 0; k < 3; k++) { o.min[k] = Math.min(o.min[k], z[k]); o.max[k] = Math.max(o.max[k], z[k]); }
      }
    }
  });
  console.log(JSON.stringify(out));
  process.exit(0);
})();
