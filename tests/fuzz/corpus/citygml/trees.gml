<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0"
 xmlns:app="http://www.opengis.net/citygml/appearance/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">
<core:cityObjectMember><veg:SolitaryVegetationObject gml:id="a"><veg:lod2ImplicitRepresentation><core:ImplicitGeometry>
<core:transformationMatrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</core:transformationMatrix><core:relativeGMLGeometry>
<gml:MultiSurface gml:id="t"><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="r">
<gml:posList>0 0 0 2 0 0 2 2 3 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
<gml:surfaceMember xlink:href="#p"/></gml:MultiSurface></core:relativeGMLGeometry><core:referencePoint><gml:Point>
<gml:pos>5 5 0</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry></veg:lod2ImplicitRepresentation>
</veg:SolitaryVegetationObject></core:cityObjectMember>
<core:cityObjectMember><veg:SolitaryVegetationObject gml:id="b"><veg:lod3ImplicitRepresentation><core:ImplicitGeometry>
<core:transformationMatrix>-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</core:transformationMatrix><core:libraryObject>a.obj
</core:libraryObject><core:relativeGMLGeometry xlink:href="#t"/><core:referencePoint><gml:Point><gml:pos>9 5 0</gml:pos>
</gml:Point></core:referencePoint></core:ImplicitGeometry></veg:lod3ImplicitRepresentation>
</veg:SolitaryVegetationObject></core:cityObjectMember>
<app:appearanceMember><app:Appearance><app:theme>visual</app:theme><app:surfaceDataMember><app:X3DMaterial gml:id="m">
<gml:name>Leaf</gml:name><app:isFront>true</app:isFront><app:diffuseColor>0 1 0</app:diffuseColor><app:transparency>0.5
</app:transparency><app:target>#t</app:target></app:X3DMaterial></app:surfaceDataMember><app:surfaceDataMember>
<app:ParameterizedTexture><app:imageURI>a.png</app:imageURI><app:target uri="#p"><app:TexCoordList>
<app:textureCoordinates ring="#r">0 0 1 0 1 1 0 0</app:textureCoordinates></app:TexCoordList></app:target>
</app:ParameterizedTexture></app:surfaceDataMember></app:Appearance></app:appearanceMember></core:CityModel>
