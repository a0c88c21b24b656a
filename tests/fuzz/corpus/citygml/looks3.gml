<CityModel xmlns="http://www.opengis.net/citygml/3.0" xmlns:con="http://www.opengis.net/citygml/construction/3.0"
 xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:app="http://www.opengis.net/citygml/appearance/3.0"
 xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:xlink="http://www.w3.org/1999/xlink">
<cityObjectMember><bldg:Building gml:id="b"><boundary><con:RoofSurface><lod2MultiSurface><gml:MultiSurface gml:id="m">
<gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="r"><gml:posList>0 0 0 2 0 0 2 2 0 0 0 0
</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></lod2MultiSurface>
</con:RoofSurface></boundary><lod1ImplicitRepresentation><ImplicitGeometry><transformationMatrix>1 0 0 0 0 1 0 0 0 0 1 0 0
0 0 1</transformationMatrix><referencePoint><gml:Point><gml:pos>1 2 3</gml:pos></gml:Point></referencePoint>
<relativeGeometry><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 0 1 0 0 1 1 0</gml:posList>
</gml:LinearRing></gml:exterior></gml:Polygon></relativeGeometry></ImplicitGeometry></lod1ImplicitRepresentation>
<appearance><app:Appearance><app:theme>a</app:theme><app:surfaceData><app:ParameterizedTexture><app:imageURI>x.jpg
</app:imageURI><app:textureParameterization><app:TextureAssociation><app:target>#p</app:target>
<app:textureParameterization><app:TexCoordList><app:textureCoordinates>0 0 1 0 1 1 0 0</app:textureCoordinates>
<app:ring>#r</app:ring></app:TexCoordList></app:textureParameterization></app:TextureAssociation>
</app:textureParameterization></app:ParameterizedTexture></app:surfaceData><app:surfaceData xlink:href="#x"/>
</app:Appearance></appearance></bldg:Building></cityObjectMember></CityModel>
